// Puts the page together: one state, what changes it, and what shows it.

function thresholdScale(page) {
  let least = Infinity, most = 0;
  for (const {pairs} of page.methods)
    for (const p of pairs.persistence)
      if (p > 0 && Number.isFinite(p)) {
        least = Math.min(least, p);
        most = Math.max(most, p);
      }
  if (!(most > 0)) return () => 0;
  least = Math.max(least, most * 1e-5);
  // 0 shows all; then even steps of the logarithm; the last shows essential points only
  return (step) => (step === 0 ? 0 : step === 1000 ? most : least * (most / least) ** (step / 1000));
}

function thresholdText(page, state) {
  const {threshold} = state, {field} = page.report;
  if (threshold === 0) return 'all';
  const extent = field.max - field.min;
  return `${formatNumber(Number(threshold.toPrecision(3)))}` +
      (extent > 0 ? ` (${Number((100 * threshold / extent).toPrecision(2))} % of the field)` : '');
}

function start(page) {
  const state = {
    threshold: 0,
    types: [false, true, true, true],
    onlyChosen: page.methods.some(({points}) => points.chosen !== null),
    surface: 'field',
    sameScale: false,
    arcs: {descending: false, ascending: false},
    shown: page.methods.map(() => true),
    selected: null,
    linked: true,
    frameTime: false,
    size: 1,
    log: true,
    diagram: 'death',
  };
  const narrow = matchMedia('(max-width: 860px)').matches;
  page.methods.forEach((_, i) => {
    state.shown[i] = i < (narrow ? 1 : 6);
  });

  const name = page.report.mesh.path.split('/').pop();
  document.title = `${name} – ${page.report.field.name} – morsel`;
  element('title').textContent = name;
  element('subtitle').textContent =
      `${page.report.field.name} from ${formatNumber(page.report.field.min)} to ${
          formatNumber(page.report.field.max)} on ` +
      `${formatCount(page.report.mesh.vertices)} vertices and ${
          formatCount(page.report.mesh.faces)} triangles`;
  fillSummary(page);
  fillDetails(page);

  let viewer = null;
  const select = (selected) => {
    state.selected = selected;
    if (selected !== null && !state.shown[selected.method]) element(`show-${selected.method}`).click();
    showSelection(page, state, select);
    if (viewer) viewer.update();
  };
  const plots = new Plots(page, state, select);
  const update = () => {
    if (viewer) viewer.update();
  };

  page.methods.forEach((method, i) => {
    const box = make('input', {type: 'checkbox', id: `show-${i}`});
    box.checked = state.shown[i];
    box.addEventListener('change', () => {
      state.shown[i] = box.checked;
      update();
    });
    element('method-choice').append(make('label', {}, box, method.name));
  });
  const bind = (id, event, change) => element(id).addEventListener(event, () => {
    change(element(id));
    update();
  });
  bind('surface', 'change', (e) => {
    state.surface = e.value;
  });
  bind('same-scale', 'change', (e) => {
    state.sameScale = e.checked;
  });
  bind('minima', 'change', (e) => {
    state.types[1] = e.checked;
  });
  bind('saddles', 'change', (e) => {
    state.types[2] = e.checked;
  });
  bind('maxima', 'change', (e) => {
    state.types[3] = e.checked;
  });
  element('only-chosen').closest('label').hidden = !state.onlyChosen;
  element('only-chosen').checked = state.onlyChosen;
  bind('only-chosen', 'change', (e) => {
    state.onlyChosen = e.checked;
  });
  bind('size', 'input', (e) => {
    state.size = 10 ** (e.valueAsNumber / 20);
  });
  bind('descending-arcs', 'change', (e) => {
    state.arcs.descending = e.checked;
  });
  bind('ascending-arcs', 'change', (e) => {
    state.arcs.ascending = e.checked;
  });
  bind('linked', 'change', (e) => {
    state.linked = e.checked;
    if (viewer && e.checked) viewer.moved(viewer.views.find((view) => !view.area.hidden) ?? viewer.views[0]);
  });
  bind('frame-time', 'change', (e) => {
    state.frameTime = e.checked;
  });
  bind('direction', 'change', (e) => {
    if (viewer) viewer.reset(e.value);
  });
  bind('reset', 'click', () => {
    if (viewer) viewer.reset(element('direction').value);
  });
  const thresholdOf = thresholdScale(page);
  const readThreshold = (e) => {
    state.threshold = Math.fround(thresholdOf(e.valueAsNumber));
    element('threshold-value').textContent = thresholdText(page, state);
    e.setAttribute('aria-valuetext', thresholdText(page, state));
    plots.moveThreshold(state.threshold);
  };
  bind('threshold', 'input', readThreshold);
  readThreshold(element('threshold'));
  element('log').addEventListener('change', () => {
    state.log = element('log').checked;
    plots.redraw();
  });
  element('diagram-kind').addEventListener('change', () => {
    state.diagram = element('diagram-kind').value;
    plots.redraw();
  });
  const step = (way) => select(neighborByPersistence(page, state, way));
  element('previous-point').addEventListener('click', () => step(-1));
  element('next-point').addEventListener('click', () => step(1));
  showSelection(page, state, select);

  try {
    viewer = new Viewer(page, state);
    viewer.onPick = select;
    for (const view of viewer.views)
      view.area.addEventListener('keydown', (event) => {
        if (event.ctrlKey || event.altKey || event.metaKey) return;
        const {key} = event;
        if (key === '0')
          viewer.reset(element('direction').value);
        else if (key === 'Escape')
          select(null);
        else if (key === 'n' || key === 'p') {
          if (state.selected === null || state.selected.method !== view.number) {
            const {points} = view.method, first = points.ranking.find((i) => view.isShown(state, i));
            select(first === undefined ? null : {method: view.number, point: first});
          } else
            step(key === 'n' ? 1 : -1);
        } else
          return;
        event.preventDefault();
      });
    viewer.update();
    viewer.reset(element('direction').value);
  } catch (error) {
    element('stage').hidden = true;
    problem(error);
  }
  return {page, state, viewer, select};
}

function problem(error) {
  element('problem').hidden = false;
  element('problem').textContent = `The page failed: ${error.message}.`;
}

async function open() {
  try {
    const library = make('script');
    library.textContent = new TextDecoder().decode(await inflate('three'));
    document.head.append(library);
    window.morsel = start(await readPage());  // for tests and debugging
    document.body.dataset.state = 'ready';
  } catch (error) {
    problem(error);
    document.body.dataset.state = 'failed';
    throw error;
  }
}
open();
