
'use strict';
// What every page shares: tables that are sorted and filtered, commands that are copied, pictures that are seen larger.
// Whatever comes from a file is inserted as text, never as markup.
const svg_space = 'http://www.w3.org/2000/svg';
const by_id = (id) => document.getElementById(id);
const data = JSON.parse(by_id('data').textContent);

function make(parent, name, attributes, text) {
  const node = name === 'svg' || parent.namespaceURI === svg_space ? document.createElementNS(svg_space, name) : document.createElement(name);
  for (const key in attributes || {}) node.setAttribute(key, attributes[key]);
  if (text !== undefined) node.textContent = text;
  parent.appendChild(node);
  return node;
}

function make_button(parent, text, action) {
  const button = make(parent, 'button', { type: 'button' }, text);
  button.addEventListener('click', action);
  return button;
}

function make_select(parent, title, entries, value, action) {
  const select = make(make(parent, 'label', {}, title + ' '), 'select');
  for (const [key, text] of entries) make(select, 'option', { value: key }, text);
  if (value !== undefined) select.value = value;
  select.addEventListener('change', action);
  return select;
}

// What a click does, Enter does too.
function on_press(node, action) {
  node.addEventListener('click', action);
  node.addEventListener('keydown', (event) => { if (event.key === 'Enter') action(event); });
}

// The number that a cell begins with, else its text; '' and '–' stand last in either direction.
function sort_key(cell) {
  const text = cell ? (cell.dataset.sort ?? cell.textContent).trim() : '';
  const number = parseFloat(text);
  return text === '' || text === '–' ? null : Number.isNaN(number) ? text : number;
}

function sort_rows(table, column, descending) {
  const body = table.tBodies[0], sign = descending ? -1 : 1;
  const keyed = [...body.rows].filter((row) => !row.querySelector('th')).map((row) => {
    let cell = null, at = 0;
    for (const one of row.cells) {
      if (at === column) cell = one;
      at += one.colSpan;
    }
    return { row, key: sort_key(cell) };
  });
  keyed.sort((x, y) => {
    if (x.key === null || y.key === null) return (x.key === null) - (y.key === null);
    if (typeof x.key === 'number' && typeof y.key === 'number') return sign * (x.key - y.key);
    if (typeof x.key !== typeof y.key) return typeof x.key === 'number' ? -1 : 1;
    return sign * x.key.localeCompare(y.key, undefined, { numeric: true });
  });
  for (const { row } of keyed) body.appendChild(row);
}

function make_sortable(table) {
  let column = 0;
  for (const head of table.rows[0].cells) {
    const own = column;
    column += head.colSpan;
    if (!head.textContent || head.classList.contains('plain')) continue;
    head.tabIndex = 0;
    head.title = 'sort';
    on_press(head, () => {
      const descending = head.getAttribute('aria-sort') === 'ascending';
      for (const other of table.rows[0].cells) other.removeAttribute('aria-sort');
      head.setAttribute('aria-sort', descending ? 'descending' : 'ascending');
      sort_rows(table, own, descending);
    });
  }
}

// Shows the rows that hold every word. Tells who listens for 'filtered'.
function make_filter(table) {
  const rows = [...table.tBodies[0].rows].filter((row) => !row.querySelector('th'));
  const texts = new Map(rows.map((row) => [row, row.textContent.toLowerCase()]));
  const bar = make(document.createElement('div'), 'div', { class: 'bar' });
  const field = make(bar, 'input', { type: 'search', class: 'filter', placeholder: 'filter: rows that hold these words', 'aria-label': 'filter' });
  const count = make(bar, 'small', { class: 'count' }, `${rows.length} rows`);
  table.before(bar);
  field.addEventListener('input', () => {
    const words = field.value.toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    for (const row of rows) {
      row.hidden = !words.every((word) => texts.get(row).includes(word));
      shown += !row.hidden;
    }
    count.textContent = words.length ? `${shown} of ${rows.length} rows` : `${rows.length} rows`;
    table.dispatchEvent(new Event('filtered'));
  });
  return bar;
}

async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const field = make(document.body, 'textarea', { class: 'above' });
    field.value = text;
    field.select();
    document.execCommand('copy');
    field.remove();
  }
}

function copy_button(parent, text, name) {
  const button = make_button(parent, name, async () => {
    await copy(text);
    button.textContent = 'copied';
    setTimeout(() => { button.textContent = name; }, 1500);
  });
  button.className = 'copy';
  return button;
}

// A panel over the page's corner, for what is too small where it stands: `show(fill)` while the pointer is on it; a
// click keeps it open.
const above = {
  kept: false,
  panel: null,
  show(fill) {
    if (this.kept) return;
    this.close();
    this.panel = make(document.body, 'div', { class: 'above' });
    fill(this.panel);
  },
  keep(fill) {
    this.close();
    this.show(fill);
    this.kept = true;
    make_button(this.panel, 'close', () => this.close());
  },
  leave() { if (!this.kept) this.close(); },
  close() {
    if (this.panel) this.panel.remove();
    this.panel = null;
    this.kept = false;
  },
};
document.addEventListener('keydown', (event) => { if (event.key === 'Escape') above.close(); });

function enlarges(node, fill) {
  node.tabIndex = 0;
  for (const event of ['mouseenter', 'focus']) node.addEventListener(event, () => above.show(fill));
  for (const event of ['mouseleave', 'blur']) node.addEventListener(event, () => above.leave());
  on_press(node, () => above.keep(fill));
}

function start_page() {
  for (const table of document.querySelectorAll('table.sortable')) {
    make_filter(table);
    make_sortable(table);
  }
  for (const code of document.querySelectorAll('code.command')) copy_button(code.closest('td') || code.parentNode, code.textContent, 'copy');
  for (const image of document.querySelectorAll('td img'))
    enlarges(image, (panel) => {
      const large = make(panel, 'img', { src: image.src, alt: image.alt });
      large.width = Math.max(480, image.naturalWidth);
      make(panel, 'small', {}, [(image.closest('tr').querySelector('.name') || image.closest('tr').cells[0]).textContent, image.alt].join(': '));
    });
}
start_page();
