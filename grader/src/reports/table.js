// Sorts the table by the heading that is clicked, again the other way round, and shows the rows that contain all words of the filter.
(() => {
  const table = document.querySelector('table.sortable');
  if (!table) return;
  const body = table.tBodies[0];
  const rows = [...body.rows];
  const headings = [...table.tHead.rows[0].cells];
  const value = (row, column) => {
    const cell = row.cells[column];
    return cell.dataset.sort === undefined ? cell.textContent.trim() : Number(cell.dataset.sort);
  };
  // Numbers come before words, and what is missing comes last in both directions.
  const compare = (a, b, sign) => {
    const missing = (x) => x === '' || x === '–';
    if (missing(a) || missing(b)) return missing(a) - missing(b);
    if (typeof a !== typeof b) return typeof a === 'number' ? -1 : 1;
    return sign * (typeof a === 'number' ? a - b : a.localeCompare(b, undefined, { numeric: true }));
  };
  headings.forEach((heading, column) => {
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = heading.textContent;
    heading.replaceChildren(button);
    button.addEventListener('click', () => {
      const sign = heading.getAttribute('aria-sort') === 'ascending' ? -1 : 1;
      headings.forEach((other) => other.removeAttribute('aria-sort'));
      heading.setAttribute('aria-sort', sign > 0 ? 'ascending' : 'descending');
      body.append(...rows.sort((a, b) => compare(value(a, column), value(b, column), sign)));
    });
  });
  const filter = document.createElement('input');
  const count = document.createElement('output');
  filter.type = 'search';
  filter.placeholder = 'Filter: name, submission, remark';
  filter.setAttribute('aria-label', 'Filter the rows');
  const show = () => {
    const words = filter.value.toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    for (const row of rows) {
      const text = row.textContent.toLowerCase();
      row.hidden = !words.every((word) => text.includes(word));
      shown += !row.hidden;
    }
    count.textContent = shown + ' of ' + rows.length;
  };
  filter.addEventListener('input', show);
  const bar = document.createElement('p');
  bar.className = 'filter';
  bar.append(filter, count);
  table.parentNode.before(bar);
  show();
})();
