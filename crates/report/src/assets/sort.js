"use strict";
// Tables that a press on a heading sorts. Each group of rows sorts by itself; a second press turns the order around.
{
  // A cell may hold more digits than it shows.
  const number = (cell) => (cell.tagName === "TH" ? NaN : parseFloat(cell.dataset.value ?? cell.textContent));
  const compareNames = (a, b) => a.textContent.trim().localeCompare(b.textContent.trim());
  const sort = (heading) => {
    const table = heading.closest("table");
    const column = heading.cellIndex;
    const groups = [...table.tBodies].filter((group) => !group.classList.contains("group"));
    const isName = groups.every((group) => [...group.rows].every((row) => Number.isNaN(number(row.cells[column]))));
    const first = isName ? "ascending" : (table.dataset.first ?? "ascending");
    const other = first === "ascending" ? "descending" : "ascending";
    const order = heading.ariaSort === first ? other : first;
    for (const one of heading.parentElement.cells) one.ariaSort = null;
    heading.ariaSort = order;
    const sign = order === "ascending" ? 1 : -1;
    // A row without a number comes last.
    const compare = (a, b) => {
      if (isName) return sign * compareNames(a, b);
      const [left, right] = [number(a), number(b)];
      if (Number.isNaN(left) || Number.isNaN(right)) return Number.isNaN(left) - Number.isNaN(right);
      return sign * (left - right);
    };
    for (const group of groups) {
      group.append(...[...group.rows].sort((a, b) => compare(a.cells[column], b.cells[column])));
    }
  };
  document.addEventListener("click", (event) => {
    const button = event.target.closest(".sortable thead button");
    if (button) sort(button.closest("th"));
  });
}
