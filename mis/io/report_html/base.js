"use strict";
// The page of a report: figures stand in it as JSON, pictures as base64 of PNG. Text from a scene gets into the page as text
// alone (textContent), never as HTML.

const $ = (id) => document.getElementById(id);
const data_of = (id) => JSON.parse($(id).textContent);
const report = data_of("report"), maps = data_of("maps"), glossary = data_of("glossary");

/// An element with properties and children; children are elements or text.
function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(properties)) {
    if (key in element && key !== "list") element[key] = value;
    else element.setAttribute(key, value);
  }
  element.append(...children.filter((c) => c !== null && c !== undefined));
  return element;
}
/// A strategy's name, which a narrow window breaks after a slash alone.
const name_parts = (name) => name.split(/(?<=\/)/).flatMap((part, i) => [...(i > 0 ? [make("wbr")] : []), make("span", { className: "part" }, part)]);
const name_text = (name) => make("bdi", { className: "name" }, ...name_parts(name));
/// A command line, broken between its words alone.
const command_text = (command) => make("bdi", {}, ...command.split(/(?<= )/).map((word) => make("span", { className: "word" }, word)));

/// What is shown: a scene (-1: all of them), and the strategy that is singled out, by name.
const shown = { scene: report.scenes.length > 1 ? -1 : 0, strategy: null };
const scene_now = () => report.scenes[shown.scene];
const maps_now = () => maps[shown.scene] ?? null;

/// Dims what belongs to other strategies than the one singled out.
function apply_choice() {
  for (const element of document.querySelectorAll("[data-strategy]")) {
    const own = shown.strategy === element.getAttribute("data-strategy");
    element.classList.toggle("dim", shown.strategy !== null && !own);
    element.classList.toggle("chosen", own && element.tagName === "TR");
    const button = element.matches("button") ? element : element.querySelector("button.pick");
    if (button) button.setAttribute("aria-pressed", own);
  }
}
function choose(name) {
  shown.strategy = shown.strategy === name ? null : name;
  apply_choice();
  if (view.mode === "winner" && view.painted) repaint();
}

/// Shows text beside the pointer, or beside an element.
function show_tip(text, x, y) {
  const tip = $("tip");
  tip.textContent = text;
  tip.hidden = false;
  const box = tip.getBoundingClientRect();
  tip.style.left = Math.max(4, Math.min(x + 14, innerWidth - box.width - 8)) + "px";
  tip.style.top = (y + 18 + box.height > innerHeight ? Math.max(4, y - box.height - 10) : y + 18) + "px";
}
const hide_tip = () => { $("tip").hidden = true; };
