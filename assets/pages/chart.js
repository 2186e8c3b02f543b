
// Measured points: a chart of error over cost, the picture of what is pointed at, and what differs among those chosen.
// A point's pictures and command are those of its row where there is a table, so that the page holds them once.
const rows = new Map([...document.querySelectorAll('tr[data-point]')].map((row) => [data.points[row.dataset.point], row]));
const chosen = [];
const letter = (i) => String.fromCharCode(65 + i % 26);
const every_light = '*';

function pictures_of(point) {
  if (point.pictures) return point.pictures.map(([i, name]) => ({ src: 'data:image/png;base64,' + data.pictures[i], name }));
  return [...rows.get(point).querySelectorAll('img')].map((image) => ({ src: image.src, name: image.alt }));
}

function figure_list(parent, pairs) {
  const list = make(parent, 'dl', { class: 'figures' });
  for (const [name, value] of pairs) {
    make(list, 'dt', {}, name);
    make(list, 'dd', {}, value);
  }
}

function show_card(point) {
  const card = by_id('card');
  card.replaceChildren();
  make(card, 'h3', {}, point.label);
  if (point.line) make(card, 'small', {}, point.line);
  const shown = make(card, 'div', { class: 'pictures' });
  for (const { src, name } of pictures_of(point)) {
    const figure = make(shown, 'figure');
    make(figure, 'img', { src, alt: name });
    make(figure, 'figcaption', {}, name);
  }
  figure_list(card, point.figures);
  const command = point.command ?? rows.get(point).querySelector('code').textContent;
  copy_button(card, command, 'copy command').title = command;
  for (const [other, row] of rows) row.classList.toggle('near', other === point);
  plot.point_at(point);
}

function toggle(point) {
  const at = chosen.indexOf(point);
  if (at < 0) chosen.push(point);
  else chosen.splice(at, 1);
  show_chosen();
}

// The rows of the table of differences: what is not the same in all.
function differences(points) {
  const lines = [];
  const line = (name, values) => { if (new Set(values).size > 1) lines.push([name, ...values]); };
  line('scene', points.map((p) => p.scene));
  line('graph', points.map((p) => p.group));
  line('compared', points.map((p) => p.line));
  for (const [key, unset, unit] of [['settings', data.unset, ''], ['figures', '–', ''], ['passes', '–', ', ms']]) {
    const maps = points.map((p) => new Map(p[key]));
    for (const name of new Set(maps.flatMap((m) => [...m.keys()]))) line(name + unit, maps.map((m) => m.get(name) ?? unset));
  }
  return lines;
}

function show_chosen() {
  const place = by_id('chosen');
  place.replaceChildren();
  plot.pick(new Map(chosen.map((point, i) => [point, letter(i)])));
  for (const [point, row] of rows) {
    row.classList.toggle('chosen', chosen.includes(point));
    row.querySelector('input').checked = chosen.includes(point);
  }
  if (!chosen.length) return;
  make(place, 'h2', {}, 'Chosen points');
  const chips = make(place, 'div', { class: 'chips' });
  chosen.forEach((point, i) => {
    const chip = make(chips, 'span', { class: 'chip' }, `${letter(i)}: ${point.label} `);
    make_button(chip, '×', () => toggle(point)).title = 'leave out';
  });
  make_button(chips, 'none', () => { chosen.length = 0; show_chosen(); });
  show_pair(place, chosen.map(pictures_of));
  if (chosen.length < 2) {
    make(place, 'p', { class: 'hint' }, 'Choose another to see what differs.');
    return;
  }
  const table = make(place, 'table', { class: 'differences narrow' });
  const head = make(table, 'tr');
  for (const text of ['what differs', ...chosen.map((_, i) => letter(i))]) make(head, 'th', {}, text);
  for (const values of differences(chosen)) {
    const row = make(table, 'tr');
    for (const text of values) make(row, 'td', {}, text);
  }
}

// Two points under a divider; a single one against the reference, where the page has that.
function show_pair(place, pictures) {
  const of_two = pictures.length === 2 && pictures.every((own) => own.length > 1), of_one = pictures.length === 1 && pictures[0].length > 2;
  if (!of_two && !of_one) return;
  const sides = of_two ? pictures.map(([own], i) => ({ src: own.src, name: letter(i) })) : [{ ...pictures[0][0], name: 'A' }, pictures[0][2]];
  const maps = pictures.map(([, map], i) => ({ src: map.src, name: `${letter(i)}: ${map.name}` }));
  new PictureView(make(place, 'div', { id: 'pair' }), sides, maps);
}

function shown_points() {
  return data.points.filter((p) => p.scene === scene_select.value && !(rows.has(p) && rows.get(p).hidden) &&
    (light === null || light.value === every_light || light.value === p.light) && (!kinds.has(p.kind) || kinds.get(p.kind).checked));
}

function draw_chart() {
  const error = data.errors.find((one) => one.key === error_select.value), cost = data.costs.find((one) => one.key === cost_select.value);
  const joint = light !== null && light.value === every_light; // all are held to all light
  const scores = shown_points()
    .map((p) => ({ item: p, x: p.numbers[cost.key], y: p.numbers[joint && error.joint ? error.joint : error.key], group: p.group, line: joint ? '' : p.line, title: p.label, label: p.mark }))
    .filter((s) => typeof s.x === 'number' && typeof s.y === 'number' && s.x > 0);
  const front = front_of(scores);
  for (const score of scores) score.full = front.has(score);
  plot.show(scores, { x: cost.title, y: joint && error.joint ? error.joint_title : error.title, share: error.share, x_share: cost.share });
}

function light_select(bar) {
  const known = data.lights.filter(({ key }) => data.points.some((p) => p.light === key)).map(({ key, title }) => [key, title]);
  return make_select(bar, 'light', [...known, [every_light, 'every method against all light']], undefined, draw_chart);
}

function kind_box(bar, kind) {
  const label = make(bar, 'label'), box = make(label, 'input', { type: 'checkbox', id: kind });
  make(label, 'span', {}, ' ' + kind);
  box.checked = true;
  box.addEventListener('change', draw_chart);
  return box;
}

const plot = new Plot(by_id('plot'), { hover: show_card, choose: toggle });
const bar = make(document.createElement('div'), 'div', { class: 'bar' });
by_id('plot').parentNode.before(bar);
const scenes = [...new Set(data.points.map((p) => p.scene))];
const scene_select = make_select(bar, data.scene_title, scenes.map((s) => [s, s]), scenes[0], draw_chart);
scene_select.id = 'scene';
scene_select.parentNode.hidden = scenes.length < 2;
const error_select = make_select(bar, 'error', data.errors.map((one) => [one.key, one.title]), data.error, draw_chart);
error_select.id = 'error';
const cost_select = make_select(bar, 'over', data.costs.map((one) => [one.key, one.title]), data.costs[0].key, draw_chart);
cost_select.id = 'cost';
const light = data.lights ? light_select(bar) : null;
if (light) light.id = 'light';
const kinds = new Map((data.kinds || []).map((kind) => [kind, kind_box(bar, kind)]));
for (const [point, row] of rows) {
  const box = make(document.createElement('div'), 'input', { type: 'checkbox', class: 'choose', 'aria-label': 'choose' });
  row.cells[0].prepend(box, ' ');
  box.addEventListener('change', () => toggle(point));
  row.addEventListener('mouseenter', () => show_card(point));
}
if (by_id('points')) by_id('points').addEventListener('filtered', draw_chart);
draw_chart();
const first = plot.marks.find((mark) => mark.full);
if (first) show_card(first.item);
