#pragma once

#include <string_view>

// How sweep.html draws the fronts of the techniques that are shown: staircase, shade, numbers, the
// sentence under the chart and the table's rows, as scatterSvg() and the page draw those of all. No
// "<" and no "&" in it, so that the page is XML too.
namespace obscura {

constexpr std::string_view sweepFrontScript = R"(
const boxes = all('.techniques input');

// A figure's picture, and its marks with their numbers and places by rising milliseconds.
const frames = all('.chart figure').map(figure => {
  const svg = figure.querySelector('svg');
  const frame = {figure, svg, measure: figure.parentElement.classList[1].slice(1)};
  for (const [name, value] of Object.entries(svg.dataset)) frame[name] = Number(value);
  frame.points = [...svg.querySelectorAll('.mark')].map(mark => {
    const [x, y] = placeOf(mark), {ms, error} = mark.dataset;
    return {mark, x, y, ms: Number(ms), error: Number(error), technique: mark.classList[1]};
  });
  frame.points.sort((one, other) => one.ms - other.ms || one.error - other.error);
  const rows = figure.closest('section').querySelectorAll('.front tbody tr');
  frame.rows = new Map([...rows].map(row => [row.querySelector('a').getAttribute('href'), row]));
  frame.count = figure.querySelector('.count').textContent;
  return frame;
});

function beats(one, other, factor) {
  const ms = one.ms * factor;
  if (ms > other.ms || one.error > other.error) return false;
  return other.ms > ms || other.error > one.error;
}

function edge(front, frame, shift) {
  if (!front.length) return '';
  const x = one => Math.min(one.x + (one.ms > 0 ? shift : 0), frame.right).toFixed(1);
  const steps = front.map(one => `H${x(one)}V${one.y.toFixed(1)}`).join('');
  return `M${x(front[0])} ${frame.top}${steps}H${frame.right}`;
}

function addTo(group, name, technique, attributes, text) {
  const element = document.createElementNS(group.namespaceURI, name);
  element.setAttribute('class', technique);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.textContent = text;
  group.append(element);
}

// As numberPlaces() has them.
function drawNumbers(front, frame) {
  const group = frame.svg.querySelector('.numbers'), places = [];
  group.replaceChildren();
  const isFree = (x, y) => y >= frame.bottom - 2 ? false : places.every(
    other => Math.abs(x - other.x) >= 17 || Math.abs(y - other.y) >= 13);
  front.forEach((one, rank) => {
    for (const away of [0, 1, 2, 3, 4, 5]) {
      const x = Math.max(one.x - 9 - 6 * away, frame.left + 9), y = one.y + 15 + 10 * away;
      if (!isFree(x, y)) continue;
      places.push({x, y});
      if (away) addTo(group, 'path', one.technique, {d: `M${one.x.toFixed(1)} ${one.y.toFixed(1)}` +
        `L${(x + 3).toFixed(1)} ${(y - 10).toFixed(1)}`}, '');
      addTo(group, 'text', one.technique, {x: x.toFixed(1), y: y.toFixed(1)}, rank + 1);
      return;
    }
  });
}

function write(front, near, shown, frame) {
  const find = name => frame.figure.querySelector(name), some = shown.length != frame.points.length;
  find('.count').textContent =
    some ? `${front.length} of the ${shown.length} configurations shown` : frame.count;
  find('.among').textContent = some ? 'shown' : 'measured';
  find('.within').hidden = !near.length;
  find('.names').textContent = near.map(
    one => frame.rows.get(one.mark.getAttribute('href')).querySelector('a').textContent).join('; ');
}

function drawFront(frame) {
  const shown = frame.points.filter(one => document.getElementById(one.technique).checked);
  const leads = factor => shown.filter(one => !shown.some(other => beats(other, one, factor)));
  const front = leads(1), near = leads(frame.factor).filter(one => !front.includes(one));
  for (const one of frame.points) {
    const row = frame.rows.get(one.mark.getAttribute('href'));
    for (const [some, onMark, inTable] of [[front, 'best', 'f'], [near, 'near', 'n']]) {
      one.mark.classList.toggle(onMark, some.includes(one));
      row.classList.toggle(inTable + frame.measure, some.includes(one));
    }
  }
  const draw = (name, path) => frame.svg.querySelector(name).setAttribute('d', path);
  const path = edge(front, frame, 0), close = front.length ? `V${frame.top}z` : '';
  draw('path.front', path);
  draw('.unsure', path + close);
  draw('.dominated', edge(front, frame, frame.shift) + close);
  drawNumbers(front, frame);
  write(front, near, shown, frame);
}

const drawFronts = () => frames.filter(frame => frame.svg.querySelector('path.front')).forEach(drawFront);
for (const box of boxes) box.addEventListener('change', drawFronts);
document.querySelector('.techniques').addEventListener('reset', () => setTimeout(drawFronts));
document.getElementById('none').addEventListener('click', () => {
  boxes.forEach(box => { box.checked = false; });
  drawFronts();
});
if (boxes.some(box => !box.checked)) drawFronts(); // as a browser remembers them
)";

} // namespace obscura
