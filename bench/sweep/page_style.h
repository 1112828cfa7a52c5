#pragma once

#include <string_view>

// How sweep.html looks and what its script does; no "<" and no "&" in either, so that the page is
// XML too.
namespace obscura {

constexpr std::string_view sweepPageStyle = R"(body { max-width: 88rem; }
.hash { font-family: monospace; overflow-wrap: anywhere; }
h3 { font-size: 1rem; margin: 1.2rem 0 .3rem; }
small { color: #555; font-size: .85em; }
.warning { border-left: 6px solid #D55E00; background: #FDF1E7; padding: .5rem 1rem; }
.tools { background: white; border-bottom: 1px solid #ccc; padding: .4rem 0; }
.tools.measures { display: flex; flex-wrap: wrap; column-gap: 2rem; }
.tools form { display: flex; flex-wrap: wrap; gap: .3rem .4rem; align-items: center; margin: .2rem 0; }
.tools label, .legend label, .tools button { font-size: .88rem; border: 1px solid #999;
  border-radius: .3rem; padding: .1rem .5rem; cursor: pointer; background: white; color: inherit; }
.tools label:has(:checked) { background: #E3EEF6; border-color: #0072B2; }
.tools label:focus-within, a:focus-visible { outline: 2px solid #0072B2; outline-offset: 1px; }
.tools input { margin: 0 .3rem 0 0; vertical-align: -.1em; }
.legend { display: flex; flex-wrap: wrap; gap: .2rem .3rem; margin: .4rem 0; }
.legend label { border-color: #ddd; padding: 0 .4rem; font-size: .8rem; }
.key { width: 1em; height: 1em; vertical-align: -.12em; overflow: visible; }
.m { display: none; }
.chart { display: grid; grid-template-columns: minmax(0, 1fr) 25rem; gap: 1.2rem; }
.chart figure { margin: 0; }
figcaption { font-size: .88rem; color: #555; }
.chart figure svg, .growths svg { width: 100%; height: auto; display: block; }
.panel { font-size: .85rem; }
.panel article { display: none; }
.panel h3 { margin-top: 0; overflow-wrap: anywhere; }
.panel table { font-size: .8rem; width: 100%; }
.panel th, .panel td { padding: .1rem .25rem; }
.panel tbody th { white-space: normal; }
.panel .aside { overflow-wrap: anywhere; }
html:not(.scripted) .panel:not(:has(:target))::before { content: "Follow a mark for its numbers."; }
html:not(.scripted) article:target, .scripted article.on { display: block; }
.thumb { aspect-ratio: 32 / 9; background: left center / contain no-repeat; }
td .thumb { width: 9rem; }
thead th.number { white-space: normal; vertical-align: bottom; }
td svg.bar { width: 6rem; height: 1em; }
svg.bar { width: 100%; height: .8em; display: block; background: #eee; }
.w0 { fill: #56B4E9; } .w1 { fill: #0072B2; } .w2 { fill: #E69F00; } .w3 { fill: #009E73; }
.work span { display: inline-block; width: .9em; height: .9em; vertical-align: -.1em; }
svg text { font-size: 13px; fill: #333; }
.axis path { stroke: #ddd; fill: none; }
.axis .minor { stroke: #f0f0f0; }
.x { text-anchor: middle; } .y { text-anchor: end; }
path.front { stroke: #333; stroke-width: 1.5; fill: none; }
.dominated, .unsure { fill: #000; fill-opacity: .03; }
.threads path, .growth path { stroke: currentColor; stroke-width: 1.2; fill: none; opacity: .35; }
.growth path { opacity: .7; }
.bars path { stroke: currentColor; stroke-width: 1; opacity: .8; }
.mark, .key, .growth use { fill: currentColor; stroke: white; stroke-width: .7; }
a { color: inherit; }
.mark { outline: none; }
.mark.best { stroke: #111; stroke-width: 1.4; }
.mark.near { stroke: #111; stroke-width: 1.1; stroke-dasharray: 2 1.6; }
.mark.on use, .mark:focus use, .mark:hover use { stroke: #111; stroke-width: 2.4; transform: scale(1.35); }
.numbers path { stroke: currentColor; stroke-width: .8; opacity: .6; }
.numbers text { text-anchor: middle; font-weight: 600; font-size: 12px; }
text.name { font-weight: 600; fill: #111; paint-order: stroke; stroke: white; stroke-width: 5px; pointer-events: none; }
table.front tbody { counter-reset: rank; }
.front tbody tr { display: none; counter-increment: rank; }
.front .c { display: none; }
.rank::before { content: counter(rank); }
.front td, .front tbody th { vertical-align: middle; padding: .15rem .5rem; }
.ranking th button { font: inherit; border: 0; background: none; padding: 0; cursor: pointer; text-align: inherit; }
summary { cursor: pointer; margin: .5rem 0; }
.side { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(40rem, 100%), 1fr)); column-gap: 2rem; }
.side > div { min-width: 0; }
.published { color: #767676; } .published small { color: inherit; }
.group { border-left: 1px solid #bbb; }
.growths { display: grid; grid-template-columns: repeat(auto-fill, minmax(18rem, 1fr)); gap: 1rem; }
.growths figure { margin: 0; }
@media (min-width: 70rem) and (min-height: 40rem) { .tools.measures { position: sticky; top: 0; z-index: 1; } }
@media (max-width: 60rem) { .chart { grid-template-columns: minmax(0, 1fr); } }
@media (max-width: 40rem) {
  body { padding: 0 .6rem; margin-top: 1rem; }
  .chart svg text { font-size: 22px; }
  .chart .up, .numbers { display: none; }
  .chart .mark use { transform: scale(1.4); }
  .chart .mark.on use, .chart .mark:focus use { transform: scale(2); }
  .panel table { font-size: .75rem; }
}
@media print {
  .tools, .tools.measures, .panel, text.name { display: none; }
  .chart { display: block; }
  .chart figure { width: 85%; }
  .mark.on use { transform: none; }
  .thumb, svg.bar, .warning { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  td .thumb { width: 7rem; }
  td svg.bar { width: 4rem; }
  .ranking { font-size: 5.5pt; }
  .ranking td:last-child { min-width: 8rem; }
  section + section { break-before: page; }
  .growths { grid-template-columns: 1fr 1fr; }
}
)";

constexpr std::string_view sweepPageScript = R"('use strict';
const all = selector => [...document.querySelectorAll(selector)];
document.documentElement.classList.add('scripted');

const placeOf = mark => {
  const {e, f} = mark.transform.baseVal[0].matrix;
  return [e, f];
};

function nameBeside(mark) {
  const name = mark.ownerSVGElement.querySelector('text.name');
  const [x, y] = placeOf(mark);
  name.textContent = mark.getAttribute('aria-label');
  const left = 756 - name.getBBox().width;
  name.setAttribute('x', Math.max(4, Math.min(x + 10, left)));
  name.setAttribute('y', y > 40 ? y - 12 : y + 28);
}

function show(link, named = true) {
  const section = link.closest('section'), address = link.getAttribute('href');
  section.querySelectorAll('.on').forEach(old => old.classList.remove('on'));
  section.querySelectorAll('text.name').forEach(old => { old.textContent = ''; });
  for (const same of section.querySelectorAll('a')) {
    if (same.getAttribute('href') !== address) continue;
    same.classList.add('on');
    if (named ? same.ownerSVGElement : null) nameBeside(same);
  }
  document.querySelector(address).classList.add('on');
}

function nearest(svg, event) {
  const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
  let best = null, least = 30;
  for (const mark of svg.querySelectorAll('.mark')) {
    if (!document.getElementById(mark.classList[1]).checked) continue;
    const [x, y] = placeOf(mark), distance = Math.hypot(x - at.x, y - at.y);
    if (least > distance) [best, least] = [mark, distance];
  }
  return best;
}

for (const svg of all('.chart figure svg'))
  for (const kind of ['pointermove', 'pointerdown'])
    svg.addEventListener(kind, event => {
      const mark = nearest(svg, event);
      if (mark) show(mark);
    });
for (const link of all('section.points a')) {
  link.addEventListener('focus', () => show(link));
  if (!link.ownerSVGElement) link.addEventListener('pointerenter', () => show(link));
  link.addEventListener('click', event => {
    event.preventDefault();
    if (link.ownerSVGElement) return;
    show(link);
    link.closest('section').querySelector('.panel').scrollIntoView({block: 'nearest'});
  });
}
for (const section of all('section.points')) {
  const links = [...section.querySelectorAll('.front .f0 a')];
  if (links.length) show(links[Math.floor(links.length / 2)], false);
}

const valueIn = (row, column) => {
  const text = row.cells[column].textContent.trim();
  const number = parseFloat(text.replace('−', '-'));
  return text === '–' ? Infinity : isNaN(number) ? text : number;
};
for (const head of all('.ranking thead th')) {
  const button = document.createElement('button');
  button.append(...head.childNodes);
  head.append(button);
  button.addEventListener('click', () => {
    const body = head.closest('table').tBodies[0], down = button.dataset.order === 'up';
    button.dataset.order = down ? 'down' : 'up';
    const rows = [...body.rows].sort((a, b) => {
      const one = valueIn(a, head.cellIndex), other = valueIn(b, head.cellIndex);
      return (one > other ? 1 : other > one ? -1 : 0) * (down ? -1 : 1);
    });
    body.append(...rows);
  });
}
let opened = [];
addEventListener('beforeprint', () => {
  opened = all('details:not([open])');
  opened.forEach(part => { part.open = true; });
});
addEventListener('afterprint', () => opened.forEach(part => { part.open = false; }));
)";

} // namespace obscura
