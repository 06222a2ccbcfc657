"use strict";
// Long tables with a column of numbers get buttons for headings, which sort.js sorts by.
for (const table of document.querySelectorAll("main table")) {
  const rows = [...table.tBodies[0].rows];
  const isNumber = (cell) => /^(-|[\d.]+( .*)?)$/.test(cell.textContent.trim());
  const hasNumbers = [...(rows[0]?.cells ?? [])].some((_, column) => rows.every((row) => isNumber(row.cells[column])));
  if (rows.length < 8 || !hasNumbers) continue;
  table.classList.add("sortable");
  for (const heading of table.tHead.rows[0].cells) {
    const button = document.createElement("button");
    button.append(...heading.childNodes);
    heading.append(button);
  }
}
