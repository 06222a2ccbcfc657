"use strict";
// Tables sort by any heading, each group of rows by itself; a second press turns the order around. What has no number comes
// last.
{
  const value = (row, column) => {
    const cell = row.cells[column];
    return column === 0 ? cell.textContent.trim() : parseFloat(cell.dataset.value);
  };
  const compare = (a, b, sign) => {
    if (typeof a === "string") return sign * a.localeCompare(b);
    if (Number.isNaN(a) || Number.isNaN(b)) return Number.isNaN(a) - Number.isNaN(b);
    return sign * (a - b);
  };
  for (const table of document.querySelectorAll("table.sortable")) {
    const headings = [...table.tHead.rows[0].cells];
    headings.forEach((heading, column) => {
      heading.querySelector("button").addEventListener("click", () => {
        const first = column === 0 ? "ascending" : table.dataset.first;
        const other = first === "ascending" ? "descending" : "ascending";
        const order = heading.ariaSort === first ? other : first;
        for (const one of headings) one.ariaSort = null;
        heading.ariaSort = order;
        const sign = order === "ascending" ? 1 : -1;
        for (const group of table.tBodies) {
          if (group.classList.contains("group")) continue;
          const rows = [...group.rows];
          rows.sort((a, b) => compare(value(a, column), value(b, column), sign));
          group.append(...rows);
        }
      });
    });
  }

  // One score at a time.
  const panels = [...document.querySelectorAll(".panel")];
  const show = () => {
    const metric = document.querySelector("[name=metric]:checked").value;
    for (const panel of panels) panel.hidden = panel.dataset.metric !== metric;
  };
  document.getElementById("metrics").addEventListener("change", show);
  show();
}
