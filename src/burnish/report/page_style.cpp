#include "burnish/report/page_style.h"

namespace burnish {

const std::string_view kPageStyle = R"css(
:root {
  --paper: #fbfaf8; --card: #ffffff; --ink: #22262c; --soft: #5a626d; --line: #e3dfd8;
  --accent: #17698a; --wrong: #a3243b; --s0: #b9b3a8; --s1: #c28a2c; --s2: #7d8f3a; --s3: #4f8f86;
  --s4: #7a6aa8; --s5: #17698a;
}
@media (prefers-color-scheme: dark) {
  :root {
    --paper: #15181c; --card: #1c2025; --ink: #e6e3dd; --soft: #a3abb5; --line: #343a42;
    --accent: #6dbbd8; --wrong: #f08a9b; --s0: #5d5f63; --s1: #d7a550; --s2: #a5b65f; --s3: #72b9ae;
    --s4: #a99ad6; --s5: #6dbbd8;
  }
}
* { box-sizing: border-box; }
html { color-scheme: light dark; }
body {
  margin: 0 auto; padding: 3rem 1.5rem 4rem; max-width: 76rem; background: var(--paper);
  color: var(--ink); font: 1rem/1.55 system-ui, "Segoe UI", "Liberation Sans", sans-serif;
}
h1, h2 { font-family: Georgia, "Liberation Serif", serif; font-weight: normal; line-height: 1.2; }
h1 { font-size: 2.3rem; margin: 0.2rem 0 0.6rem; overflow-wrap: anywhere; }
h2 { font-size: 1.55rem; margin: 3.2rem 0 0.9rem; }
h3 { font-size: 1rem; font-weight: 600; margin: 1.8rem 0 0.6rem; }
h3 span { color: var(--soft); font-weight: normal; }
p { max-width: 46rem; margin: 0.5rem 0; }
code, .code {
  font: 0.87em/1.5 ui-monospace, "DejaVu Sans Mono", "Liberation Mono", monospace;
  overflow-wrap: anywhere;
}
.kind { color: var(--soft); letter-spacing: 0.08em; text-transform: uppercase; font-size: 0.78rem; margin: 0; }
.code { display: block; padding: 0.7rem 0.9rem; background: var(--card); border: 1px solid var(--line);
  border-radius: 6px; white-space: pre-wrap; max-width: none; }
.tiles { display: flex; flex-wrap: wrap; gap: 0.8rem; margin: 1.8rem 0 0; padding: 0; list-style: none; }
.tiles li { flex: 1 1 10rem; padding: 0.9rem 1.1rem; background: var(--card);
  border: 1px solid var(--line); border-radius: 8px; }
.tiles b { display: block; font: normal 1.6rem/1.25 Georgia, "Liberation Serif", serif; }
.tiles span { color: var(--soft); font-size: 0.87rem; }
.tiles .wrong b { color: var(--wrong); }
.plate .row { display: grid; grid-template-columns: repeat(auto-fit, minmax(15rem, 1fr)); gap: 0.8rem; }
.plate figure { margin: 0; }
.plate img { display: block; width: 100%; height: auto; border-radius: 6px; border: 1px solid var(--line); }
.plate figcaption { color: var(--soft); font-size: 0.87rem; padding: 0.3rem 0.1rem; }
.swatch { display: inline-block; width: 0.9em; height: 0.9em; border-radius: 3px; margin: 0 0.4em 0 0;
  vertical-align: -0.1em; border: 1px solid var(--line); }
.legend { color: var(--soft); font-size: 0.87rem; max-width: none; }
.legend span:not(.key):not(.swatch) { margin-right: 1.4em; }
.scale { display: flex; align-items: center; gap: 0.6rem; color: var(--soft); font-size: 0.87rem; margin: 0.4rem 0; }
.scale svg { width: 16rem; height: 0.8rem; border-radius: 3px; }
.charts { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(27rem, 100%), 1fr)); gap: 1.6rem; }
.chart { margin: 0; padding: 1rem 1.1rem 0.5rem; background: var(--card); border: 1px solid var(--line); border-radius: 8px; }
.chart figcaption { font-weight: 600; margin-bottom: 0.4rem; }
.chart svg { display: block; width: 100%; height: auto; }
.chart text { fill: var(--soft); font-size: 12.5px; font-family: inherit; font-variant-numeric: tabular-nums; }
.axis, .grid, .mark { fill: none; stroke: var(--soft); stroke-width: 1; }
.grid { stroke: var(--line); }
.mark { stroke-dasharray: 2 4; }
.curve { fill: none; stroke-width: 1.6; stroke-linejoin: round; }
.curve.s0 { fill: var(--s0); fill-opacity: 0.55; stroke: none; }
.curve.s1 { stroke: var(--s1); stroke-dasharray: 7 3; } .curve.s2 { stroke: var(--s2); stroke-dasharray: 3 3; }
.curve.s3 { stroke: var(--s3); stroke-dasharray: 9 3 2 3; } .curve.s4 { stroke: var(--s4); stroke-dasharray: 5 2; }
.curve.s5 { stroke: var(--s5); stroke-width: 2.6; }
.key { display: inline-block; width: 1.6em; height: 0; margin-right: 0.45em; vertical-align: 0.28em;
  border-top: 3px solid var(--s0); }
.key.s0 { height: 0.8em; border: 0; background: var(--s0); vertical-align: -0.1em; border-radius: 2px; }
.key.s1 { border-top: 2px dashed var(--s1); } .key.s2 { border-top: 2px dotted var(--s2); }
.key.s3 { border-top: 2px dashed var(--s3); } .key.s4 { border-top: 2px dashed var(--s4); }
.key.s5 { border-color: var(--s5); }
.scroll { overflow-x: auto; margin: 1.4rem 0; }
table { border-collapse: collapse; font-size: 0.93rem; }
caption { text-align: left; font-weight: 600; padding: 0 0 0.5rem; }
th, td { text-align: left; padding: 0.34rem 1.5rem 0.34rem 0; border-bottom: 1px solid var(--line); vertical-align: top; }
thead th, thead td { color: var(--soft); font-weight: 600; border-bottom-color: var(--soft); }
tbody th { font-weight: normal; }
td.number, td.wrong { font-variant-numeric: tabular-nums; white-space: nowrap; }
.numbers td, .numbers thead th { text-align: right; padding: 0.34rem 0 0.34rem 1.6rem; }
td.wrong { color: var(--wrong); font-weight: 700; }
.steps { width: 100%; }
.steps tbody th { font-weight: 600; white-space: nowrap; }
.steps .method { color: var(--soft); font-weight: normal; }
.pairs { list-style: none; margin: 0; padding: 0; }
.pairs span { color: var(--soft); }
.pairs b { font-weight: normal; font-variant-numeric: tabular-nums; }
.plain { padding-left: 1.2rem; max-width: 46rem; overflow-wrap: anywhere; }
.tabs { display: flex; flex-wrap: wrap; gap: 0.4rem; margin: 0.8rem 0; }
button { font: inherit; font-size: 0.9rem; color: var(--ink); background: var(--card); cursor: pointer;
  border: 1px solid var(--line); border-radius: 999px; padding: 0.25rem 0.95rem; }
button[aria-pressed=true] { background: var(--accent); border-color: var(--accent); color: var(--paper); }
:focus-visible { outline: 2px solid var(--accent); outline-offset: 2px; }
dialog { border: 1px solid var(--line); border-radius: 10px; padding: 1rem; background: var(--paper);
  color: var(--ink); width: min(96vw, 62rem); max-width: none; }
dialog::backdrop { background: rgb(10 12 15 / 0.65); }
dialog img { display: block; width: 100%; max-height: 78vh; object-fit: contain; }
.zoom { cursor: zoom-in; }
footer { margin-top: 3.5rem; padding-top: 1rem; border-top: 1px solid var(--line); color: var(--soft); font-size: 0.87rem; }
@media print {
  :root { --paper: #fff; --card: #fff; --ink: #000; --soft: #444; --line: #ccc; --accent: #17698a;
    --wrong: #a3243b; --s0: #b9b3a8; --s5: #17698a; }
  body { max-width: none; padding: 0; font-size: 10pt; }
  .tabs, dialog { display: none; }
  .plate[hidden] { display: block !important; }
  .plate .row { grid-auto-flow: column; grid-template-columns: none; grid-auto-columns: 1fr; }
  .charts { grid-template-columns: 1fr 1fr; }
  .plate, .chart, tr, .tiles li { break-inside: avoid; }
  h2, h3, caption { break-after: avoid; }
}
)css";

const std::string_view kPageScript = R"js(
(() => {
  const make = (tag, text, parent) => {
    const element = document.createElement(tag);
    element.textContent = text;
    parent.append(element);
    return element;
  };
  const press = (buttons, chosen) =>
    buttons.forEach((b) => b.setAttribute('aria-pressed', String(b === chosen)));

  const plates = [...document.querySelectorAll('.plate')];
  if (plates.length === 0) return;
  const tabs = document.createElement('div');
  tabs.className = 'tabs';
  plates[0].before(tabs);
  const buttons = ['all views', ...plates.map((plate) => plate.dataset.name)].map((name, i) => {
    const button = make('button', name, tabs);
    button.onclick = () => {
      plates.forEach((plate, k) => { plate.hidden = i > 0 && k !== i - 1; });
      press(buttons, button);
    };
    return button;
  });
  press(buttons, buttons[0]);

  const dialog = make('dialog', '', document.body);
  const large = make('img', '', dialog);
  const phases = make('div', '', dialog);
  phases.className = 'tabs';
  const show = (images, index) => {
    large.src = images[index].src;
    large.alt = images[index].alt;
    press([...phases.children], phases.children[index]);
    dialog.onkeydown = (event) => {
      const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      if (step) show(images, (index + step + images.length) % images.length);
    };
  };
  dialog.onclick = (event) => { if (event.target === dialog || event.target === large) dialog.close(); };
  for (const plate of plates) {
    const images = [...plate.querySelectorAll('img')];
    images.forEach((image, index) => {
      image.className = 'zoom';
      image.tabIndex = 0;
      const open = () => {
        phases.replaceChildren();
        images.forEach((other, k) => { make('button', other.dataset.phase, phases).onclick = () => show(images, k); });
        show(images, index);
        dialog.showModal();
      };
      image.onclick = open;
      image.onkeydown = (event) => { if (event.key === 'Enter') open(); };
    });
  }
})();
)js";

}  // namespace burnish
