// Sets the formulas of a model's page as mathematics, by the scripts of the lesson.
document.querySelectorAll("#formula ol pre").forEach((block) => {
  const symbols = block.textContent.trim(), set = document.createElement("div");
  set.title = symbols;
  set.append(...mathOf(symbols).flatMap((node) => [node, "\u2003"]));
  (block.closest("div[class^='highlight-']") ?? block).replaceWith(set);
});
