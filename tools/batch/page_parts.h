#pragma once
/// The style and the script of the page. Internal.

#include <string_view>

namespace morsel::tools::batch {

inline constexpr std::string_view kPageStyle = R"css(
:root { --ground: #fff; --line: #d5d9df; --text: #1c2026; --soft: #59626e; --accent: #0b62b8; --bad: #cf2436;
  font: 15px/1.45 system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", "DejaVu Sans", sans-serif;
  color: var(--text); background: var(--ground); }
@media (prefers-color-scheme: dark) {
  :root { --ground: #14171b; --line: #3a424c; --text: #e7eaee; --soft: #a2acb8; --accent: #6db3f8; --bad: #ff5a66; }
}
body { margin: 0 auto; max-width: 1680px; padding: 0 24px 24px; }
h1 { font-size: 1.5rem; overflow-wrap: anywhere; }
a { color: var(--accent); }
.plots { display: flex; flex-wrap: wrap; gap: 16px; margin-bottom: 20px; }
.plots figure { margin: 0; background: #fff; border: 1px solid var(--line); border-radius: 6px; padding: 6px; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: 5px 12px; text-align: right; border-bottom: 1px solid var(--line); }
thead th { color: var(--soft); vertical-align: bottom; max-width: 240px; overflow-wrap: break-word; }
tbody th, thead th:first-child, .text { text-align: left; overflow-wrap: anywhere; }
tbody th { min-width: 8em; }
.text { min-width: 8em; max-width: 320px; }
.failed .text { color: var(--bad); }
img { display: block; background: #fff; border-radius: 4px; }
button { font: inherit; color: inherit; background: none; border: 0; padding: 2px; cursor: pointer; text-align: inherit; }
[aria-sort=ascending] button::after { content: " \25B2"; }
[aria-sort=descending] button::after { content: " \25BC"; }
:focus-visible { outline: 3px solid var(--accent); outline-offset: 2px; }
footer { margin-top: 16px; color: var(--soft); overflow-wrap: anywhere; }
)css";

/// A click on a column's head sorts by it, a second one the other way round; what has no value stays last.
inline constexpr std::string_view kPageScript = R"js(
"use strict";
const body = document.querySelector("tbody");
const heads = [...document.querySelectorAll("thead th")];
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
  });
}
)js";

}  // namespace morsel::tools::batch
