"use strict";
for (const table of document.querySelectorAll("table.comparison")) {
  const body = table.tBodies[0];
  const heads = [...table.tHead.rows[0].cells];
  table.tHead.addEventListener("click", (event) => {
    const button = event.target.closest("button");
    if (!button) return;
    const head = button.parentElement;
    const column = heads.indexOf(head);
    const descending = head.getAttribute("aria-sort") === "ascending";
    for (const other of heads) if (other.hasAttribute("aria-sort")) other.setAttribute("aria-sort", "none");
    head.setAttribute("aria-sort", descending ? "descending" : "ascending");
    const value = (row) => row.cells[column].dataset.value;
    const rank = (a, b) => {
      const [x, y] = [value(a), value(b)];
      // what a design does not have stays at the end
      if (x === undefined || y === undefined) return (x === undefined) - (y === undefined);
      const numbers = [Number(x.replace("inf", "Infinity")), Number(y.replace("inf", "Infinity"))];
      const order = numbers.some(Number.isNaN) ? x.localeCompare(y) : numbers[0] - numbers[1];
      return descending ? -order : order;
    };
    body.append(...[...body.rows].sort(rank));
  });
}
