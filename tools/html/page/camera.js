// A camera that orbits a target, and its pointer and keyboard input.

const directions = {
  '+z': [0, 0, 0],
  '-z': [0, Math.PI, 0],
  '+x': [0, Math.PI / 2, 0],
  '-x': [0, -Math.PI / 2, 0],
  '+y': [-Math.PI / 2, 0, 0],
  '-y': [Math.PI / 2, 0, 0],
};

class Orbit {
  constructor() { this.reset('+z', [0.5, 0.5, 0.5], 1); }

  /**
   * Looks from a direction, so that a box of these half sizes round the origin fills a view of that aspect.
   */
  reset(direction, half, aspect) {
    this.target = new THREE.Vector3();
    this.rotation = new THREE.Quaternion().setFromEuler(new THREE.Euler(...directions[direction], 'YXZ'));
    const depth = {x: 0, y: 1, z: 2}[direction[1]], across = depth === 0 ? 2 : 0, up = depth === 1 ? 2 : 1;
    const reach = 1.22 * Math.max(half[up], half[across] / aspect, 0.02);
    this.distance = reach / Math.tan(fieldOfView / 2) + half[depth];
    this.fitted = aspect;
  }
  copy(other) {
    this.target = other.target.clone();
    this.rotation = other.rotation.clone();
    this.distance = other.distance;
    this.fitted = other.fitted;
  }
  /** Angles about the screen's upright and level axes. */
  turn(right, down) {
    const step = new THREE.Quaternion().setFromEuler(new THREE.Euler(-down, -right, 0, 'YXZ'));
    this.rotation.multiply(step).normalize();
  }
  zoom(factor) { this.distance = Math.min(20, Math.max(0.02, this.distance * factor)); }
  /** By shares of the view's height. */
  move(right, up) {
    const size = 2 * this.distance * Math.tan(fieldOfView / 2);
    this.target.add(new THREE.Vector3(-right * size, -up * size, 0).applyQuaternion(this.rotation));
  }
  apply(camera, aspect) {
    camera.position.copy(
        new THREE.Vector3(0, 0, this.distance).applyQuaternion(this.rotation).add(this.target));
    camera.quaternion.copy(this.rotation);
    const reach = 0.52 + this.target.length();  // of the model from the target
    camera.near = Math.max(this.distance - reach, 0.02 * this.distance, 0.004);
    camera.far = this.distance + reach;
    camera.aspect = aspect;
    // a narrower view keeps its horizontal field of view
    camera.fov = 180 / Math.PI * 2 * Math.atan(Math.tan(fieldOfView / 2) * Math.max(1, this.fitted / aspect));
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
  }
}
const fieldOfView = 32 * Math.PI / 180;

/**
 * Lets pointer, wheel and keys on `area` move orbit(); calls moved() after each move and clicked(event) for
 * a click.
 */
function attachControls(area, orbit, moved, clicked) {
  const pointers = new Map();
  let travelled = 0;
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return {x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, size: Math.hypot(a.x - b.x, a.y - b.y)};
  };
  area.addEventListener('pointerdown', (event) => {
    area.focus({preventScroll: true});
    area.setPointerCapture(event.pointerId);
    if (pointers.size === 0) travelled = 0;
    pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
    area.classList.add('turning');
    event.preventDefault();
  });
  area.addEventListener('pointermove', (event) => {
    if (!pointers.has(event.pointerId)) return;
    const height = area.clientHeight, before = pointers.get(event.pointerId);
    const old = pointers.size === 2 ? spread() : null;
    const dx = event.clientX - before.x, dy = event.clientY - before.y;
    pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
    travelled += Math.hypot(dx, dy);
    if (old !== null) {
      const now = spread();
      orbit().zoom(old.size / Math.max(now.size, 1));
      orbit().move((now.x - old.x) / height, -(now.y - old.y) / height);
    } else if (event.buttons & 2 || event.shiftKey) {
      orbit().move(dx / height, -dy / height);
    } else {
      orbit().turn(4 * dx / height, 4 * dy / height);
    }
    moved();
  });
  const release = (event) => {
    if (!pointers.delete(event.pointerId)) return;
    if (pointers.size === 0) area.classList.remove('turning');
    if (event.type === 'pointerup' && event.button === 0 && travelled < 5 && pointers.size === 0)
      clicked(event);
  };
  area.addEventListener('pointerup', release);
  area.addEventListener('pointercancel', release);
  area.addEventListener('contextmenu', (event) => event.preventDefault());
  area.addEventListener('wheel', (event) => {
    event.preventDefault();
    orbit().zoom(Math.exp(Math.max(-1, Math.min(1, event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015)))));
    moved();
  }, {passive: false});
  area.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const arrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
    if (event.key in arrows) {
      const [x, y] = arrows[event.key];
      if (event.shiftKey)
        orbit().move(0.06 * x, -0.06 * y);
      else
        orbit().turn(0.12 * x, 0.12 * y);
    } else if (event.key === '+' || event.key === '=')
      orbit().zoom(1 / 1.15);
    else if (event.key === '-')
      orbit().zoom(1.15);
    else
      return;
    event.preventDefault();
    moved();
  });
}
