// Tabs by the pattern of the ARIA authoring guide: arrows move, one panel shows. Without script all panels show.
for (const bar of document.querySelectorAll(".tabs")) {
  const buttons = [...bar.querySelectorAll("button")];
  const choose = (chosen) =>
    buttons.forEach((b) => {
      b.setAttribute("aria-selected", b === chosen);
      b.tabIndex = b === chosen ? 0 : -1;
      document.getElementById(b.getAttribute("aria-controls")).hidden = b !== chosen;
    });
  buttons.forEach((b, k) => {
    b.addEventListener("click", () => choose(b));
    b.addEventListener("keydown", (e) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[e.key];
      if (!step) return;
      const next = buttons[(k + step + buttons.length) % buttons.length];
      choose(next);
      next.focus();
    });
  });
  if (buttons.length) choose(buttons[0]);
}
