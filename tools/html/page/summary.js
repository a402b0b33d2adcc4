// The table of methods, and how everything was made.

function fillSummary(page) {
  const {report} = page;
  const isChosen = report.methods.some(({chosen}) => chosen);
  const ofChosen = isChosen ? ['chosen', 'kept', 'moved', 'added', 'percentile'] : [];
  const header = [
    'method', 'minima', 'saddles', '(multiplicity)', 'maxima', 'total', 'pairs', 'above 1 %', 'arcs', 'cells',
    'kept', 'moved', 'added', ...ofChosen, 'seconds'
  ];
  const rows = report.methods.map((method, i) => {
    const points = method.critical_points, timing = report.timings.methods[i];
    const seconds =
        Object.entries(timing).filter(([key]) => key !== 'name').reduce((sum, [, s]) => sum + s, 0);
    const {kept, moved, added} = method.compared_to_first;
    const above = method.persistence.above.find((entry) => entry.percent === 1).pairs;
    const numbers = [
      points.minima, points.saddles, points.saddle_multiplicity, points.maxima, points.total,
      method.persistence.pairs, above, method.ms_complex.arcs, method.ms_complex.cells, kept, moved,
      added
    ];
    return make(
        'tr', {}, make('th', {scope: 'row'}, page.methods[i].name),
        ...numbers.map((n) => make('td', {}, formatCount(n))), ...chosenCells(method.chosen),
        make('td', {}, seconds.toFixed(2)));
  });
  element('summary').append(
      make('thead', {}, make('tr', {}, ...header.map((name) => make('th', {scope: 'col'}, name)))),
      make('tbody', {}, ...rows));
  report.methods.forEach((method, i) => {
    for (const section of [method.target, method.chosen])
      if (section && section.note)
        element('notes').append(make('li', {}, `${page.methods[i].name}: ${section.note}`));
  });
}

/** The points that were chosen: how many, and compared with those of the first method. */
function chosenCells(chosen) {
  if (!chosen) return [];
  const {kept, moved, added} = chosen.compared_to_first, mean = chosen.mean_percentile;
  return [
    ...[chosen.count, kept, moved, added].map((n) => make('td', {}, formatCount(n))),
    make('td', {}, mean === null ? '—' : mean.toFixed(2))
  ];
}

/** A value of the report as short text. */
function valueText(value) {
  if (value === null) return '∞ or none';
  if (typeof value === 'number')
    return Number.isInteger(value) ? String(value).replace('-', '−') : formatNumber(value);
  if (Array.isArray(value)) return value.map(valueText).join(', ');
  return String(value);
}

function keyValueTable(caption, entries) {
  const rows =
      entries.map(([key, value]) => make('tr', {}, make('td', {}, key), make('td', {}, valueText(value))));
  return make('div', {}, make('h3', {}, caption), make('table', {}, make('tbody', {}, ...rows)));
}

/** One step's values as entries, a chain's with the steps' names. */
function stepEntries(section) {
  if (!section || typeof section !== 'object' || Array.isArray(section)) return [];
  const isChain =
      Array.isArray(section.steps) && section.steps.every((s) => s && typeof s === 'object' && 'values' in s);
  if (!isChain) return Object.entries(section);
  return section.steps.flatMap(
      ({name, values}) => Object.entries(values).map(([key, value]) => [`${name}: ${key}`, value]));
}

function fillDetails(page) {
  const {report} = page, {mesh, field} = report;
  const columns = make('div', {class: 'columns'});
  const repairs = mesh.repairs.map((r) => `${r.action} ${r.count}`).join(', ') || 'none';
  columns.append(keyValueTable('Mesh', [
    ['file', mesh.path], ['SHA-256', mesh.sha256], ['vertices', formatCount(mesh.vertices)],
    ['edges', formatCount(mesh.edges)], ['triangles', formatCount(mesh.faces)],
    ['components', mesh.components], ['boundary loops', mesh.boundary_loops], ['genus', mesh.genus],
    ['Euler characteristic', mesh.euler_characteristic], ['box diagonal', mesh.bbox_diagonal],
    ['repairs', repairs], ...(mesh.warnings || []).map((text) => ['warning', text])
  ]));
  columns.append(keyValueTable(`Field: ${field.name}`, [
    ['range', `${formatNumber(field.min)} to ${formatNumber(field.max)}`],
    ...Object.entries(field.parameters), ['seconds', report.timings.field.toFixed(3)]
  ]));
  report.methods.forEach((method, i) => {
    const timing = Object.entries(report.timings.methods[i])
                       .filter(([key]) => key !== 'name')
                       .map(([step, s]) => [`seconds: ${step}`, s.toFixed(3)]);
    const target =
        method.target ? [['target', `${method.target.wanted} wanted, ${method.target.reached} reached`]] : [];
    columns.append(keyValueTable(`Method: ${page.methods[i].name}`, [
      ...stepEntries(method.parameters), ...stepEntries(method.details),
      ['range', `${formatNumber(method.field.min)} to ${formatNumber(method.field.max)}`], ...target,
      ...timing
    ]));
  });
  columns.append(keyValueTable(
      'Seconds in all',
      [['loading', report.timings.load.toFixed(3)], ['total', report.timings.total.toFixed(3)]]));
  element('details').append(columns);
  element('command').textContent = page.command;
  element('version').textContent = `Made by ${report.tool.name} ${report.tool.version}. ` +
      'Positions are rounded to 1/65536 of the model\'s size here, the field\'s colours to 1/65536 of ' +
      'their range; values of critical points are exact.';
  element('copy').addEventListener('click', () => copyCommand(page.command));
}

async function copyCommand(text) {
  const button = element('copy');
  try {
    await navigator.clipboard.writeText(text);
    button.textContent = 'Copied';
  } catch {  // not allowed here: it is selected instead, to be copied by hand
    getSelection().selectAllChildren(element('command'));
    button.textContent = 'Selected';
  }
  setTimeout(() => {
    button.textContent = 'Copy';
  }, 2000);
}
