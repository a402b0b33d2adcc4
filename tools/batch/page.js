"use strict";
const table = document.querySelector(".collection");
const body = table.tBodies[0];
const heads = [...table.tHead.rows[0].cells];

// A click on a column's head sorts by it, a second one the other way round; what has no value stays last.
const compare = (a, b) => (isNaN(a) || isNaN(b)) ? a.localeCompare(b) : a - b;
for (const [column, head] of heads.entries()) {
  head.querySelector("button")?.addEventListener("click", () => {
    const down = head.getAttribute("aria-sort") === "ascending";
    for (const other of heads) other.removeAttribute("aria-sort");
    head.setAttribute("aria-sort", down ? "descending" : "ascending");
    const value = row => row.cells[column].dataset.v;
    const rows = [...body.rows];
    const there = rows.filter(row => value(row) !== undefined);
    there.sort((a, b) => (down ? -1 : 1) * compare(value(a), value(b)));
    body.append(...there, ...rows.filter(row => value(row) === undefined));
    show();
  });
}

// The search text is looked for in a mesh's name, status and error. Of very many rows only the first are
// shown until all are requested: browsers
  // take long to lay out ten thousand.
const find = document.getElementById("find");
const found = document.getElementById("found");
const all = document.getElementById("all");
let limit = Number(table.dataset.first);
const show = () => {
  const wanted = find.value.toLowerCase();
  let matching = 0;
  for (const row of body.rows) {
    const matches = row.textContent.toLowerCase().includes(wanted);
    matching += matches;
    row.hidden = !matches || matching > limit;
  }
  all.hidden = matching <= limit;
  found.textContent = (wanted ? `${matching} of ${body.rows.length}` : "") +
      (all.hidden ? "" : ` The first ${limit} are shown.`);
};
let later = 0;
find.addEventListener("input", () => {
  clearTimeout(later);
  later = setTimeout(show, 150);
});
all.addEventListener("click", () => {
  limit = Infinity;
  show();
});
show();
document.body.dataset.state = "ready";
