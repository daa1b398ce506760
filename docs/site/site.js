// Opens a walker's page inside this one, once it is asked for. Without this the link opens it by itself; so it does on narrow screens.
const least_width_px = 760;

function enclose(link) {
  const figure = link.parentElement, hero = link.closest(".hero");
  const frame = document.createElement("iframe");
  frame.src = link.getAttribute("href");
  frame.title = link.dataset.frame;
  const bar = document.createElement("p");
  bar.className = "actions";
  const close = document.createElement("button");
  close.type = "button";
  close.textContent = "Close";
  const whole = link.cloneNode(false);
  whole.className = "";
  whole.textContent = "In the whole window";
  bar.append(close, " ", whole);
  close.addEventListener("click", () => {
    frame.remove();
    bar.remove();
    link.hidden = false;
    hero?.classList.remove("running");
    link.focus();
  });
  hero?.classList.add("running");
  link.hidden = true;
  figure.prepend(frame, bar);
  frame.scrollIntoView({ block: "nearest" });
  frame.addEventListener("load", () => frame.focus(), { once: true });
}

for (const link of document.querySelectorAll("a.stage"))
  link.addEventListener("click", (event) => {
    if (event.ctrlKey || event.metaKey || event.shiftKey || event.altKey || innerWidth < least_width_px) return;
    event.preventDefault();
    enclose(link);
  });
