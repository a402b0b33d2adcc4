// Persistence diagrams, and the curves of counts.

/** How many pairs are more persistent than x; `ascending` holds their persistences. */
function countAbove(ascending, x) {
  let low = 0, high = ascending.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (ascending[middle] > x)
      high = middle;
    else
      low = middle + 1;
  }
  return ascending.length - low;
}

/**
 * Curves over the same x; a figure whose cursor reads them all. series: {name, color, dash, at(x),
 * path(figure), top}
 */
function curveFigure(caption, describe, series, options) {
  const figure = new Figure(caption, describe);
  for (const one of series) figure.key(one.color, one.dash, one.name);
  const show = (x) => {
    const at = figure.x.pixel(x);
    figure.cursor.replaceChildren(makeSvg('path', {d: `M${at} ${figure.y.to}V${figure.y.from}`}));
    figure.readout.textContent = `${options.xName} ${formatNumber(x)}: ` +
        series.map((one) => [one.name, one.at(x)])
            .filter(([, n]) => n !== null)
            .map(([name, n]) => `${name} ${formatCount(n)}`)
            .join(', ');
    figure.shown = x;
  };
  figure.draw = () => {
    const isLog = options.log();
    const x = options.range(isLog);
    figure.axes(
        x, {
          low: isLog ? 0.8 * options.least : 0,
          high: Math.max(1, ...series.map((one) => one.top)) * 1.15,
          isLog
        },
        options.xName, options.yName);
    for (const one of series) figure.line(one.path(figure), one.color, one.dash);
    if (options.threshold) {
      figure.mark = makeSvg('path', {class: 'threshold'});
      figure.svg.append(figure.mark);
      figure.moveMark = (t) =>
          figure.mark.setAttribute('d', t > 0 ? `M${figure.x.pixel(t)} ${figure.y.to}V${figure.y.from}` : '');
      figure.moveMark(options.threshold());
    }
  };
  figure.hover = (px) => {
    const x = figure.x.value(Math.max(figure.x.from, Math.min(figure.x.to, px)));
    show(options.whole ? Math.round(x) : x);
  };
  figure.step = (way) => {
    const now = figure.shown ?? figure.x.low;
    if (options.whole)
      return show(
          Math.max(Math.ceil(figure.x.low), Math.min(Math.floor(figure.x.high), Math.round(now) + way)));
    figure.hover(figure.x.pixel(now) + way * (figure.x.to - figure.x.from) / 60);
  };
  return figure;
}

function persistenceCurves(page, state) {
  let least = Infinity, most = 0;
  const series = page.methods.map((method, i) => {
    const ascending = method.pairs.persistence;  // infinite ones last
    const finite = ascending.filter((p) => p > 0 && Number.isFinite(p));
    if (finite.length > 0) {
      least = Math.min(least, finite[Math.floor(finite.length * 0.002)]);
      most = Math.max(most, finite[finite.length - 1]);
    }
    return {
      name: method.name,
      color: methodColor(i),
      dash: methodDash(i),
      top: ascending.length,
      at: (x) => countAbove(ascending, x),
      path: (figure) => {  // a step wherever it is seen
        let path = '', lastX = NaN;
        const point = (x, n) => {
          const px = figure.x.pixel(x).toFixed(1);
          path += path === '' ? `M${px} ${figure.y.pixel(n).toFixed(1)}` :
                                `H${px}V${figure.y.pixel(n).toFixed(1)}`;
        };
        point(figure.x.low, countAbove(ascending, figure.x.low));
        for (let k = 0; k < finite.length; ++k) {
          const px = Math.round(2 * figure.x.pixel(finite[k]));
          if (finite[k] <= figure.x.low || (px === lastX && k + 1 < finite.length)) continue;
          lastX = px;
          point(finite[k], countAbove(ascending, finite[k]));
        }
        return path + `H${figure.x.to}`;
      },
    };
  });
  if (!(most > 0)) [least, most] = [0.1, 1];
  return curveFigure(
      ['Pairs above a persistence'],
      'Curves: number of pairs whose persistence is above a value, by method. Arrow keys read them.', series,
      {
        xName: 'persistence',
        yName: 'pairs',
        least: 1,
        log: () => state.log,
        threshold: () => state.threshold,
        range: (isLog) =>
            (isLog ? {low: least, high: most * 1.05, isLog} : {low: 0, high: most * 1.05, isLog})
      });
}

/** The counted iterations of a method's steps: [{step, records}]. */
function iterationsOf(report) {
  const steps = report.iterations;
  if (Array.isArray(steps)) return steps.length > 0 ? [{step: '', records: steps}] : [];
  return steps.steps.filter((s) => s.values.length > 0)
      .map((s) => ({step: ` (${s.name})`, records: s.values}));
}

function iterationCurves(page, state) {
  const series = [];
  page.methods.forEach((method, i) => {
    for (const {step, records} of iterationsOf(method.report)) {
      const totals = new Map(records.map((r) => [r.iteration, r.total]));
      series.push({
        name: method.name + step,
        color: methodColor(i),
        dash: methodDash(i),
        top: Math.max(...totals.values()),
        bottom: Math.min(...totals.values()),
        last: records[records.length - 1].iteration,
        at: (x) => totals.get(x) ?? null,
        path: (figure) =>
            records
                .map(
                    (r, k) => `${k === 0 ? 'M' : 'L'}${figure.x.pixel(r.iteration).toFixed(1)} ${
                        figure.y.pixel(r.total).toFixed(1)}`)
                .join(''),
      });
    }
  });
  if (series.length === 0) return null;
  const last = Math.max(1, ...series.map((one) => one.last));
  const least = Math.max(1, Math.min(...series.map((one) => one.bottom)));
  return curveFigure(
      ['Critical points after each iteration'],
      'Curves: number of critical points after each iteration, by method. Arrow keys read them.', series, {
        xName: 'iteration',
        yName: 'critical points',
        least,
        log: () => state.log,
        whole: true,
        range: () => ({low: 0, high: last, isLog: false})
      });
}

/** The caption of a method's persistence diagram, with the number of its pairs. */
function diagramCaption(method, finite) {
  const rest = method.pairs.count - finite.length;
  return [
    make('span', {}, method.name),
    make(
        'small', {},
        ` ${formatCount(finite.length)} pairs` +
            (rest > 0 ? `, ${formatCount(rest)} infinite ones not drawn` : ''))
  ];
}

/** The axes of a persistence diagram; returns the range that births and deaths share. */
function diagramAxes(figure, births, ys, byDeath, log) {
  const isLog = !byDeath && log;
  const low = least(births, 0), high = most(births, 1);
  const positive = ys.filter((y) => y > 0);
  const all = {
    low: least([...births, ...(byDeath ? ys : [])], 0),
    high: most([...births, ...(byDeath ? ys : [])], 1)
  };
  figure.axes(
      byDeath ? {...all, isLog: false} : {low, high, isLog: false},
      byDeath   ? {...all, isLog: false} :
          isLog ? {low: least(positive, 0.1), high: most(positive, 1) * 1.2, isLog} :
                  {low: 0, high: most(ys, 1) * 1.05, isLog},
      'birth', byDeath ? 'death' : 'persistence');
  if (byDeath)
    figure.svg.append(makeSvg('path', {
      class: 'axis',
      d: `M${figure.x.pixel(all.low)} ${figure.y.pixel(all.low)}L${figure.x.pixel(all.high)} ${
          figure.y.pixel(all.high)}`
    }));
  return all;
}

/** A dot at each place, those of minima in one path, those of maxima in another one. */
function diagramDots(figure, places, ofMinimum) {
  const size = places.length > 2000 ? 3 : places.length > 200 ? 4 : 5.5;
  for (const isMinimum of [true, false]) {
    let path = '';
    const seen = new Set();
    for (const {k, x, y} of places) {
      if (ofMinimum(k) !== isMinimum) continue;
      const dot = `M${x.toFixed(1)} ${y.toFixed(1)}h0`;
      if (!seen.has(dot)) {
        seen.add(dot);
        path += dot;
      }
    }
    figure.svg.append(makeSvg('path', {
      d: path,
      fill: 'none',
      'stroke-linecap': 'round',
      'stroke-width': size,
      'stroke-opacity': places.length > 200 ? 0.6 : 0.85,
      stroke: isMinimum ? 'var(--minimum)' : 'var(--maximum)'
    }));
  }
}

/** The line at a threshold: a parallel of the diagonal among deaths, else a horizontal one. */
function diagramMark(figure, all, byDeath) {
  figure.mark = makeSvg('path', {class: 'threshold'});
  figure.svg.append(figure.mark);
  figure.moveMark = (t) => figure.mark.setAttribute(
      'd',
      !(t > 0)    ? '' :
          byDeath ? `M${figure.x.pixel(all.low)} ${figure.y.pixel(all.low + t)}L${
                        figure.x.pixel(all.high - t)} ${figure.y.pixel(all.high)}` :
                    `M${figure.x.from} ${figure.y.pixel(t)}H${figure.x.to}`);
}

/** What the readout says about pair k. */
function pairText(page, {pairs, points}, k, isOfMinimum) {
  const [first, second] =
      isOfMinimum ? [pairs.extremum[k], pairs.saddle[k]] : [pairs.saddle[k], pairs.extremum[k]];
  const name = (p) => `${typeNames[points.type[p]]} ${page.mesh.inputVertex(points.vertex[p])}`;
  return `${name(first)} at ${formatNumber(pairs.birth[k])}, ${name(second)} at ${
      formatNumber(pairs.death[k])}: persistence ${formatNumber(pairs.persistence[k])}`;
}

/** Lets the pointer find the nearest of the places, arrow keys go through them; choose(k) on a click. */
function explorePlaces(figure, placesOf, textOf, choose) {
  let at = -1;
  const show = (n) => {
    at = n;
    const {k, x, y} = placesOf()[n];
    figure.cursor.replaceChildren(makeSvg('circle', {cx: x, cy: y, r: 6}));
    figure.readout.textContent = textOf(k);
  };
  figure.hover = (px, py) => {
    let best = -1, distance = 30 ** 2;
    placesOf().forEach(({x, y}, n) => {
      const d = (x - px) ** 2 + (y - py) ** 2;
      if (d < distance) {
        distance = d;
        best = n;
      }
    });
    if (best < 0)
      figure.clear();
    else
      show(best);
    at = best;
  };
  figure.step = (way) => {
    const count = placesOf().length;
    if (count > 0) show(Math.max(0, Math.min(count - 1, at < 0 ? count - 1 : at + way)));
  };
  const chooseHere = () => {
    if (at >= 0) choose(placesOf()[at].k);
  };
  figure.svg.addEventListener('click', chooseHere);
  figure.svg.addEventListener('keydown', (event) => {
    if (event.key === 'Enter') chooseHere();
  });
}

/** Birth and death (or persistence) of each pair; the pointer finds the nearest, a click selects it. */
function diagramFigure(page, state, method, i, select) {
  const {pairs, points} = method;
  const finite = [];
  for (let k = 0; k < pairs.count; ++k)
    if (Number.isFinite(pairs.death[k])) finite.push(k);
  const figure = new Figure(
      diagramCaption(method, finite),
      `Persistence diagram of ${method.name}, ${
          finite.length} finite pairs. Arrow keys go through them by persistence.`);
  figure.keys.append(
      make('span', {}, make('i', {class: 'dot minimum'}), 'minimum and saddle'),
      make('span', {}, make('i', {class: 'dot maximum'}), 'saddle and maximum'));
  const ofMinimum = (k) => points.type[pairs.extremum[k]] === 1;
  let places = [];
  figure.draw = () => {
    const byDeath = state.diagram === 'death';
    const births = finite.map((k) => pairs.birth[k]);
    const ys = finite.map((k) => (byDeath ? pairs.death[k] : pairs.persistence[k]));
    const all = diagramAxes(figure, births, ys, byDeath, state.log);
    places = finite.map((k, n) => ({k, x: figure.x.pixel(births[n]), y: figure.y.pixel(ys[n])}));
    diagramDots(figure, places, ofMinimum);
    diagramMark(figure, all, byDeath);
    figure.moveMark(state.threshold);
  };
  explorePlaces(
      figure, () => places, (k) => pairText(page, method, k, ofMinimum(k)),
      (k) => select({method: i, point: pairs.extremum[k]}));
  return figure;
}

function least(values, otherwise) {
  return values.length === 0 ? otherwise : values.reduce((a, b) => Math.min(a, b));
}
function most(values, otherwise) {
  return values.length === 0 ? otherwise : values.reduce((a, b) => Math.max(a, b));
}

class Plots {
  constructor(page, state, select) {
    this.curves =
        [persistenceCurves(page, state), iterationCurves(page, state)].filter((figure) => figure !== null);
    this.diagrams = page.methods.map((method, i) => diagramFigure(page, state, method, i, select));
    element('curves').append(...this.curves.map((figure) => figure.node));
    element('diagrams').append(...this.diagrams.map((figure) => figure.node));
  }
  redraw() {
    for (const figure of [...this.curves, ...this.diagrams]) figure.redraw();
  }
  moveThreshold(t) {
    for (const figure of [...this.curves, ...this.diagrams])
      if (figure.moveMark) figure.moveMark(t);
  }
}
