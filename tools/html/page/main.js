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

function initialState(page) {
  const shownAtFirst = matchMedia('(max-width: 860px)').matches ? 1 : 6;
  return {
    threshold: 0,
    types: [false, true, true, true],
    onlyChosen: page.methods.some(({points}) => points.chosen !== null),
    surface: 'field',
    sameScale: false,
    arcs: {descending: false, ascending: false},
    shown: page.methods.map((_, i) => i < shownAtFirst),
    selected: null,
    linked: true,
    frameTime: false,
    size: 1,
    log: true,
    diagram: 'death',
  };
}

function fillTitle({report}) {
  const {mesh, field} = report;
  const name = mesh.path.split('/').pop();
  document.title = `${name} – ${field.name} – morsel`;
  element('title').textContent = name;
  element('subtitle').textContent =
      `${field.name} from ${formatNumber(field.min)} to ${formatNumber(field.max)} on ` +
      `${formatCount(mesh.vertices)} vertices and ${formatCount(mesh.faces)} triangles`;
}

/** Calls change(element) on an event of the element `id`, and then after(). */
function bind(id, event, change, after) {
  element(id).addEventListener(event, () => {
    change(element(id));
    after();
  });
}

function bindMethodChoice(page, state, update) {
  page.methods.forEach((method, i) => {
    const box = make('input', {type: 'checkbox', id: `show-${i}`});
    box.checked = state.shown[i];
    box.addEventListener('change', () => {
      state.shown[i] = box.checked;
      update();
    });
    element('method-choice').append(make('label', {}, box, method.name));
  });
}

/** The controls that change what the views show, but not how they look at it. */
function bindAppearance(state, update) {
  const set = (id, event, change) => bind(id, event, change, update);
  set('surface', 'change', (e) => {
    state.surface = e.value;
  });
  set('same-scale', 'change', (e) => {
    state.sameScale = e.checked;
  });
  for (const [type, id] of [[1, 'minima'], [2, 'saddles'], [3, 'maxima']])
    set(id, 'change', (e) => {
      state.types[type] = e.checked;
    });
  element('only-chosen').closest('label').hidden = !state.onlyChosen;
  element('only-chosen').checked = state.onlyChosen;
  set('only-chosen', 'change', (e) => {
    state.onlyChosen = e.checked;
  });
  set('size', 'input', (e) => {
    state.size = 10 ** (e.valueAsNumber / 20);
  });
  set('descending-arcs', 'change', (e) => {
    state.arcs.descending = e.checked;
  });
  set('ascending-arcs', 'change', (e) => {
    state.arcs.ascending = e.checked;
  });
  set('frame-time', 'change', (e) => {
    state.frameTime = e.checked;
  });
}

/** The controls of the cameras; viewerNow() is null while there is no viewer. */
function bindCameras(state, viewerNow, update) {
  bind('linked', 'change', (e) => {
    state.linked = e.checked;
    const viewer = viewerNow();
    if (viewer && e.checked) viewer.moved(viewer.views.find((view) => !view.area.hidden) ?? viewer.views[0]);
  }, update);
  const reset = () => {
    const viewer = viewerNow();
    if (viewer) viewer.reset(element('direction').value);
  };
  bind('direction', 'change', reset, update);
  bind('reset', 'click', reset, update);
}

function bindThreshold(page, state, plots, update) {
  const thresholdOf = thresholdScale(page);
  const read = (e) => {
    state.threshold = Math.fround(thresholdOf(e.valueAsNumber));
    element('threshold-value').textContent = thresholdText(page, state);
    e.setAttribute('aria-valuetext', thresholdText(page, state));
    plots.moveThreshold(state.threshold);
  };
  bind('threshold', 'input', read, update);
  read(element('threshold'));
}

function bindPlots(state, plots) {
  const redraw = () => plots.redraw();
  bind('log', 'change', (e) => {
    state.log = e.checked;
  }, redraw);
  bind('diagram-kind', 'change', (e) => {
    state.diagram = e.value;
  }, redraw);
}

/** The keys of a view: 0 resets the cameras, Escape deselects, n and p go through its points. */
function bindKeys(viewer, view, state, select, step) {
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
}

function start(page) {
  const state = initialState(page);
  fillTitle(page);
  fillSummary(page);
  fillDetails(page);

  let viewer = null;
  const update = () => {
    if (viewer) viewer.update();
  };
  const select = (selected) => {
    state.selected = selected;
    if (selected !== null && !state.shown[selected.method]) element(`show-${selected.method}`).click();
    showSelection(page, state, select);
    update();
  };
  const plots = new Plots(page, state, select);
  bindMethodChoice(page, state, update);
  bindAppearance(state, update);
  bindCameras(state, () => viewer, update);
  bindThreshold(page, state, plots, update);
  bindPlots(state, plots);
  const step = (way) => select(neighborByPersistence(page, state, way));
  element('previous-point').addEventListener('click', () => step(-1));
  element('next-point').addEventListener('click', () => step(1));
  showSelection(page, state, select);

  try {
    viewer = new Viewer(page, state);
    viewer.onPick = select;
    for (const view of viewer.views) bindKeys(viewer, view, state, select, step);
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

/** Waits for the page's width: a frame in a process of its own runs scripts before it is laid out. */
function hasWidth() {
  return new Promise((resolve) => {
    if (innerWidth > 0) return resolve();
    const observer = new ResizeObserver(() => {
      if (innerWidth === 0) return;
      observer.disconnect();
      resolve();
    });
    observer.observe(document.documentElement);
  });
}

async function open() {
  try {
    const library = make('script');
    library.textContent = new TextDecoder().decode(await inflate('three'));
    document.head.append(library);
    const page = await readPage();
    await hasWidth();
    window.morsel = start(page);  // for tests and debugging
    document.body.dataset.state = 'ready';
  } catch (error) {
    problem(error);
    document.body.dataset.state = 'failed';
    throw error;
  }
}
open();
