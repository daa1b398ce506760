// Experiments for a lesson: settings, a question to think about before, and what to look for after. `steps` are runs one after the other;
// the curve of the run before stays in the diagram to compare with.

// In experiments that compare: enough robots for species to be seen.
const SIXTY = { population: 60, generations: 100 };
const compared = ({ steps, ...rest }) => ({ ...rest, steps: steps.map(({ name, set }) => ({ name, set: { ...SIXTY, ...set } })) });

const FIRST = [
  { id: "first", title: "The first steps", question: "The first networks are random. Will any of them walk? How would you find out which is the best of twenty bad ones?",
    steps: [{ name: "Evolve a walker", set: {} }],
    look: "When does the curve rise: slowly, or in jumps? What does the walker do differently after a jump? Which feet move together?" },
  { id: "luck", title: "Luck", question: "If the same evolution began again with other dice, would it find the same way of walking?",
    steps: [{ name: "Seed 1", set: { seed: 1 } }, { name: "Seed 2", set: { seed: 2 } }, { name: "Seed 3", set: { seed: 3 } }],
    look: "How far apart are the curves? Anything you compare in the other experiments must be larger than that. Let everybody in the class take a seed: it stays when another experiment is set up." },
];

const COMPARISONS = [
  { id: "trigger", title: "Without feeling its feet", question: "A foot that touches the ground starts its leg’s movement anew. What if the movements just repeat, whatever the feet feel?",
    steps: [{ name: "With touch", set: {} }, { name: "Without touch", set: { feels: false } }],
    look: "Which one gets farther? Push both (drag the body; below the curves the best of the run before walks once more): which one finds its rhythm again?" },
  { id: "together", title: "All legs start together", question: "The network also decides when each leg starts: its offset. What can a robot do whose legs must all start together?",
    steps: [{ name: "Own starts", set: {} }, { name: "All together", set: { controller: "together" } }],
    look: "Look at the feet: do the legs stay together? Touch can drive them apart again. How? Watch each to its end: who falls? Compare what each typically does, too." },
  { id: "mutation", title: "No mutation", question: "Children are mixed from their parents, but nothing new is ever added. How long can that go on getting better?",
    steps: [{ name: "With mutations", set: {} }, { name: "Only mixing", set: { mutation: "none" } }],
    look: "Look at how near the median comes to the best: children do much the same as their parents, even in several species. How long does the best still rise?" },
  { id: "growth", title: "A network that cannot grow", question: "Mutations usually add nodes and links. Is that needed to walk?",
    steps: [{ name: "It may grow", set: {} }, { name: "It stays as it is", set: { mutation: "weights" } }],
    look: "Count the nodes of each champion’s network. Do the painted patterns have more bends where it may grow?" },
  { id: "novelty", title: "Novelty against distance", question: "What if nobody is rewarded for walking far, but only for ending where nobody has ended before?",
    steps: [{ name: "Reward distance", set: {} }, { name: "Reward what is new", set: { search: "novelty" } }],
    look: "Look at the places where the robots end, before you set up the next step: which search spreads more? Does it also find good walkers, though it does not look for them?" },
  { id: "leg", title: "A leg is lost", question: "At generation 50 every robot loses its first leg. How far will the best of them then still walk, and how long until evolution has an answer?",
    steps: [{ name: "Lose a leg at generation 50", set: { lost: "first", lostAt: 50, generations: 120 } }],
    look: "How deep is the fall at the dashed line? Does the new walk use the same patterns, or others?" },
  { id: "mars", title: "On Mars", question: "Gravity on Mars is 38 % of ours. Will robots get farther, or will they fall over?",
    steps: [{ name: "On Earth", set: {} }, { name: "On Mars", set: { gravity: 0.38 } }],
    look: "Do they walk, or jump? Are feet longer in the air? Try the Moon (0.17), too." },
  { id: "tiny", title: "A tiny population", question: "Ten parents for 300 generations, or sixty for 50: as many trials. Which would you choose?",
    steps: [{ name: "60 × 50", set: { population: 60, generations: 50 } }, { name: "10 × 300", set: { population: 10, generations: 300 } }],
    look: "Which curve has longer flat stretches? How many species are left of ten?" },
  { id: "sine", title: "Sine waves against SUPGs", question: "A network that hears a clock, a sine wave, and feels joints and feet can move every joint, too. Who gets farther: patterns that each touch begins anew, or a network with a clock?",
    steps: [{ name: "SUPGs", set: {} }, { name: "Sine waves", set: { controller: "sine" } }],
    look: "Compare the best, but also what it typically does. When both runs are over, choose another ground, and let each walk there: which one minds more?" },
  { id: "noise", title: "One walk is not a gait", question: "Without any noise each walk is exactly the same every time. Is the best then a good walker, or a lucky one?",
    steps: [{ name: "No noise", set: { noise: "none" } }, { name: "A little noise", set: { noise: "little" } }, { name: "Pushes, too", set: { noise: "strong" } }],
    look: "Compare “best so far” with “best, typically”. Without noise, typically stands for starts that differ by a thousandth of a radian; with noise, for other noise of the same kind. Who repeats what it did once?" },
  { id: "rough", title: "Hurdles", question: "Bars lie across the way, a fifth of a leg high, in rings around the start. Does who grew up among them walk better there than who grew up on flat ground?",
    steps: [{ name: "Flat", set: { roughness: 0.2 } }, { name: "Hurdles", set: { ground: "hurdles", roughness: 0.2 } }],
    look: "Look at the feet from the side. When both runs are over, choose the other ground, and let each walk there: who minds more, the walker of the flat ground or that of the hurdles?" },
  { id: "map", title: "Not one winner, but many", question: "What if the best of each kind is kept: those that slide, those that hop, tall ones, low ones?",
    steps: [{ name: "Fill a map", set: { search: "map-elites", generations: 150 } }],
    look: "Choose cells of the map: who walks there? Where are cells that stay empty, and why can nobody walk like that?" },
];

export const EXPERIMENTS = [...FIRST, ...COMPARISONS.map(compared)];
