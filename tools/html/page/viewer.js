// The models, side by side on one canvas (browsers allow few WebGL contexts), drawn only when something
// changed.

/** One method's model: its part of the canvas, its objects, its camera. */
class View {
  constructor(page, parts, i) {
    this.method = page.methods[i];
    this.number = i;
    this.mesh = page.mesh;
    this.surface = new Surface(parts, this.method);
    this.spheres = new Spheres(page.mesh, this.method.points);
    this.scene = new THREE.Scene();
    this.scene.add(this.surface.object, this.spheres.object);
    this.arcs = {};
    this.orbit = new Orbit();
    this.camera = new THREE.PerspectiveCamera();
    // so large that they do not cover the surface, and not smaller nor larger than is pleasant
    const {points} = this.method;
    const count = points.chosen === null ? points.count : points.chosen.filter((k) => k > 0).length;
    const room = Math.sqrt(parts.area / Math.max(1, count));
    this.radius = Math.min(0.0105, Math.max(0.0032, 0.16 * room));

    this.area =
        make('div', {class: 'view', tabindex: '0', role: 'application', 'aria-roledescription': 'model'});
    this.caption = make('div', {class: 'caption'});
    this.bar = make('div', {class: 'bar'});
    this.low = make('span');
    this.middle = make('span');
    this.high = make('span');
    this.legend = make(
        'div', {class: 'legend'}, this.bar, make('div', {class: 'ends'}, this.low, this.middle, this.high));
    this.area.append(this.caption, this.legend);
  }

  isShown(state, i) {
    return isPointShown(this.method.points, state, i);
  }

  arcsOf(kind) {
    if (!(kind in this.arcs)) {  // made when first needed
      const color = kind === 'descending' ? [0.05, 0.16, 0.45] : [0.50, 0.04, 0.10];
      this.arcs[kind] = new Arcs(arcPieces(this.mesh, this.method, kind), color);
      this.scene.add(this.arcs[kind].object);
    }
    return this.arcs[kind];
  }

  update(state, scale, fieldName) {
    this.surface.color(state.surface, scale);
    for (const kind of ['descending', 'ascending'])
      if (state.arcs[kind] || kind in this.arcs) {
        const arcs = this.arcsOf(kind);
        arcs.setThreshold(state.threshold);
        arcs.object.visible = state.arcs[kind] && !arcs.isEmpty;
      }
    const uniforms = this.spheres.material.uniforms;
    this.spheres.setThreshold(state.threshold);
    this.spheres.select(
        state.selected !== null && state.selected.method === this.number ? state.selected.point : -1);
    uniforms.kinds.value.set(...[1, 2, 3].map((type) => (state.types[type] ? 1 : 0)));
    uniforms.onlyChosen.value = state.onlyChosen ? 1 : 0;
    uniforms.radius.value = this.drawnRadius = this.radius * state.size;

    const counts = [0, 0, 0, 0], {points} = this.method;
    const count = shownCount(points.rankedShown, state.threshold);
    for (let rank = 0; rank < count; ++rank) {
      const i = points.ranking[rank];
      if (!state.onlyChosen || points.chosen[i] > 0) ++counts[points.type[i]];
    }
    const texts =
        [1, 2, 3].map((type) => `${formatCount(counts[type])} ${['', 'minima', 'saddles', 'maxima'][type]}`);
    this.caption.replaceChildren(this.method.name, make('small', {}, texts.join(', ')));
    this.area.setAttribute('aria-label', `${this.method.name}: ${texts.join(', ')}`);
    this.legend.hidden = state.surface !== 'field';
    this.bar.style.background = cssRamp(scale.bytes);
    this.low.textContent = formatShort(scale.low);
    this.middle.textContent = scale.isSigned ? '0' : '';
    this.high.textContent = formatShort(scale.high);
    this.legend.title = fieldName;
  }
}

function formatShort(x) { return String(Number(x.toPrecision(3))).replace('-', '−'); }

class Viewer {
  constructor(page, state) {
    this.page = page;
    this.state = state;
    this.canvas = element('canvas');
    const context =
        this.canvas.getContext('webgl2', {antialias: true, alpha: true, powerPreference: 'high-performance'});
    if (context === null)
      throw new Error('this browser shows no WebGL 2, which the models need; numbers and plots are below');
    this.renderer = new THREE.WebGLRenderer({canvas: this.canvas, context, antialias: true, alpha: true});
    this.renderer.autoClear = false;
    this.parts = new SurfaceParts(page.mesh);
    this.views = page.methods.map((_, i) => new View(page, this.parts, i));
    this.onPick = () => {};
    for (const view of this.views) {
      element('views').append(view.area);
      attachControls(view.area, () => view.orbit, () => this.moved(view), (event) => this.click(view, event));
    }
    this.waiting = false;
    this.frames = 0;
    new ResizeObserver(() => this.draw()).observe(element('views-box'));
    this.canvas.addEventListener('webglcontextrestored', () => this.draw());
  }

  moved(view) {
    if (this.state.linked)
      for (const other of this.views)
        if (other !== view) other.orbit.copy(view.orbit);
    this.draw();
  }

  reset(direction) {
    const shown = this.views.find((view) => !view.area.hidden) ?? this.views[0];
    const aspect = shown.area.hidden ? 1 : shown.area.clientWidth / shown.area.clientHeight;
    for (const view of this.views) view.orbit.reset(direction, this.page.mesh.half, aspect);
    this.draw();
  }

  click(view, event) {
    const box = view.area.getBoundingClientRect();
    const {state} = this;
    const i = pickPoint(
        this.page.mesh, view.camera, view.spheres, (k) => view.isShown(state, k), view.drawnRadius,
        event.clientX - box.left, event.clientY - box.top, box.width, box.height);
    this.onPick(i < 0 ? null : {method: view.number, point: i});
  }

  /** Where a point is on the page, in CSS pixels from the window's corner. */
  placeOnPage(method, point) {
    const view = this.views[method], box = view.area.getBoundingClientRect();
    const at = projectPoint(view.camera, view.spheres.centers, point, box.width, box.height);
    return {
      x: box.left + at.x,
      y: box.top + at.y,
      hidden: isHidden(
          this.page.mesh, view.camera.position.toArray(),
          [0, 1, 2].map((c) => view.spheres.centers[3 * point + c]), view.drawnRadius)
    };
  }

  /** After the state has changed. */
  update() {
    const {state} = this;
    const shown = this.views.filter((view) => state.shown[view.number]);
    const columns = this.columns(shown.length);
    element('views').style.setProperty('--columns', columns);
    const first = this.page.methods[0].values;
    const isSigned = bothSigns(first.range);  // one choice for the fields of all methods
    for (const view of this.views) {
      view.area.hidden = !state.shown[view.number];
      if (view.area.hidden) continue;
      const {range} = state.sameScale ? first : view.method.values;
      view.update(state, scaleFor(range, isSigned || bothSigns(range)), this.page.report.field.name);
    }
    this.draw();
  }

  columns(count) {
    if (matchMedia('(max-width: 860px)').matches) return 1;
    return count === 4 ? 2 : Math.min(Math.max(count, 1), 3);
  }

  draw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.drawNow();
    });
  }

  drawNow() {
    const begin = performance.now();
    const box = this.canvas.getBoundingClientRect();
    const narrow = matchMedia('(max-width: 860px)').matches;
    element('views').style.setProperty(
        '--columns', this.columns(this.views.filter((view) => !view.area.hidden).length));
    // no larger than what every device can draw on
    const ratio =
        Math.min(window.devicePixelRatio, narrow ? 2 : 3, 4096 / Math.max(box.width, box.height, 1));
    const {renderer} = this;
    renderer.setPixelRatio(ratio);
    renderer.setSize(box.width, box.height, false);
    renderer.setScissorTest(false);
    renderer.setClearColor(0, 0);
    renderer.clear();
    renderer.setScissorTest(true);
    for (const view of this.views) {
      const part = view.area.getBoundingClientRect();
      if (view.area.hidden || part.width < 1) continue;
      const left = part.left - box.left, bottom = box.bottom - part.bottom;
      renderer.setViewport(left, bottom, part.width, part.height);
      renderer.setScissor(left, bottom, part.width, part.height);
      view.orbit.apply(view.camera, part.width / part.height);
      view.spheres.material.uniforms.pixels.value = part.height * ratio;
      view.spheres.projection.copy(view.camera.projectionMatrix);
      for (const arcs of Object.values(view.arcs)) {
        arcs.material.uniforms.viewport.value.set(part.width * ratio, part.height * ratio);
        arcs.material.uniforms.width.value = 2.2 * ratio;
      }
      renderer.render(view.scene, view.camera);
    }
    ++this.frames;
    if (this.state.frameTime) {
      const pixel = new Uint8Array(4), gl = renderer.getContext();
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);  // waits until all is drawn
      element('frame').textContent = `${(performance.now() - begin).toFixed(1)} ms, ${
          formatCount(renderer.info.render.triangles)} triangles a model`;
    } else {
      element('frame').textContent = '';
    }
  }
}
