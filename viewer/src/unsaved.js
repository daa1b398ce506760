// What was computed in a page is lost with it: the browser asks before the page is left or loaded anew.

/** @param {() => boolean} isUnsaved whether something would be lost */
export function askBeforeLeaving(isUnsaved) {
  addEventListener("beforeunload", (event) => {
    if (!isUnsaved()) return;
    event.preventDefault();
    event.returnValue = true; // for browsers of before 2024
  });
}
