// The data of the selected critical point.

/**
 * The counterpart of a point in another method, in the terms of the comparison: both are matched with the
 * first method's points.
 */
function fateIn(page, from, point, to) {
  const source = page.methods[from].points, target = page.methods[to].points;
  const same = target.byVertex.get(source.vertex[point]);
  if (same !== undefined && target.type[same] === source.type[point]) return {word: 'kept', point: same};
  const reference = from === 0 ? point : source.match[point] - 1;
  const counterpart = reference < 0 ? undefined : to === 0 ? reference : target.byMatch.get(reference);
  return counterpart === undefined ? {word: 'gone', point: -1} : {word: 'moved', point: counterpart};
}

function showSelection(page, state, select) {
  const box = element('selected');
  if (state.selected === null) {
    box.replaceChildren(make('p', {}, 'No point is selected. Click on one in a model or a diagram.'));
    return;
  }
  const {method: m, point: i} = state.selected;
  const method = page.methods[m], {points} = method, {mesh} = page;
  const type = typeNames[points.type[i]];
  const entries = [
    ['vertex', String(mesh.inputVertex(points.vertex[i]))], ['value', formatNumber(points.value[i])],
    ['persistence', formatNumber(points.persistence[i])]
  ];
  if (points.chosen !== null)
    entries.push(['chosen', points.chosen[i] > 0 ? `as number ${points.chosen[i]}` : 'no']);
  if (points.multiplicity[i] > 1) entries.push(['multiplicity', String(points.multiplicity[i])]);
  const partners =
      (points.partners.get(i) ?? [])
          .map(
              (p) =>
                  (p >= points.count ? `boundary loop ${p - points.count}` :
                                       `${typeNames[points.type[p]]} ${mesh.inputVertex(points.vertex[p])}`));
  entries.push(['paired with', partners.join(', ') || 'nothing: essential']);
  if (points.origin[i] === 0)
    entries.push(['origin', 'lost']);
  else {
    const origin = points.origin[i] - 1, a = mesh.place(points.vertex[i]), b = mesh.place(origin);
    const moved = Math.hypot(...a.map((x, c) => x - b[c]));
    entries.push([
      'origin',
      origin === points.vertex[i] ?
          'the same vertex' :
          `vertex ${mesh.inputVertex(origin)}, ${formatNumber(Number(moved.toPrecision(3)))} away`
    ]);
  }
  entries.push([
    'position', mesh.place(points.place[i]).map((x) => formatNumber(Number(x.toPrecision(5)))).join(', ')
  ]);
  const list = make('dl');
  for (const [key, value] of entries) list.append(make('dt', {}, key), make('dd', {}, value));

  const fates = make('ul');
  page.methods.forEach((other, to) => {
    if (to === m) return;
    const fate = fateIn(page, m, i, to);
    const item = make('li', {}, make('strong', {}, other.name), `: ${fate.word}`);
    if (fate.point >= 0) {
      const go =
          make('button', {type: 'button'}, `vertex ${mesh.inputVertex(other.points.vertex[fate.point])}`);
      go.addEventListener('click', () => select({method: to, point: fate.point}));
      item.append(fate.word === 'moved' ? ' to ' : ' at ', go);
    }
    fates.append(item);
  });
  box.replaceChildren(make('h3', {}, make('i', {class: `dot ${type}`}), `${type} of ${method.name}`), list);
  if (fates.children.length > 0) box.append(make('div', {}, 'In other methods'), fates);
}

function isPointShown(points, state, i) {
  return state.types[points.type[i]] && (!state.onlyChosen || points.chosen[i] > 0) &&
      (state.threshold === 0 || points.shown[i] > state.threshold);
}

/** The next or the previous of the points that are shown, by falling persistence. */
function neighborByPersistence(page, state, way) {
  const m = state.selected !== null ? state.selected.method : state.shown.findIndex((shown) => shown);
  if (m < 0) return null;
  const {points} = page.methods[m];
  const shown = points.ranking.filter((i) => isPointShown(points, state, i));
  if (shown.length === 0) return null;
  const at = state.selected === null ? -1 : shown.indexOf(state.selected.point);
  const next = at < 0 ? (way > 0 ? 0 : shown.length - 1) : (at + way + shown.length) % shown.length;
  return {method: m, point: shown[next]};
}
