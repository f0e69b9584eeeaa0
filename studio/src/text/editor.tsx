// The model's text beside its drawing. Both represent the same text: typing changes the drawing, and drawing changes the text.
import { type CompletionContext, autocompletion, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, indentWithTab } from "@codemirror/commands";
import { HighlightStyle, StreamLanguage, bracketMatching, syntaxHighlighting } from "@codemirror/language";
import { toml } from "@codemirror/legacy-modes/mode/toml";
import { type Diagnostic, lintGutter, setDiagnostics } from "@codemirror/lint";
import { highlightSelectionMatches, searchKeymap } from "@codemirror/search";
import { Annotation, EditorState } from "@codemirror/state";
import { EditorView, drawSelection, highlightActiveLine, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import { useEffect, useRef } from "react";
import { editText, redo, undo } from "../actions";
import type { Complaint } from "../kernel/protocol";
import { Typing } from "../model/strokes";
import { nodeAt } from "../model/toml";
import { studio } from "../state";
import { complete } from "./completion";

const typing = new Typing();
const FromDrawing = Annotation.define<boolean>();
let shown: EditorView | null = null;
let wanted: { line: number; column: number } | null = null;

const colours = HighlightStyle.define([
  { tag: tags.comment, color: "var(--ink-faint)", fontStyle: "italic" },
  { tag: [tags.string, tags.special(tags.string)], color: "var(--code-string)" },
  { tag: [tags.number, tags.bool, tags.atom], color: "var(--code-number)" },
  { tag: [tags.propertyName, tags.variableName], color: "var(--code-key)" },
  { tag: tags.heading, color: "var(--accent-text)", fontWeight: "600" },
]);

/** Moves the cursor to a place in the text, now or once the editor exists. */
export function showPlace(line: number, column: number): void {
  wanted = { line, column };
  if (shown) goToWanted(shown);
}

function goToWanted(view: EditorView): void {
  if (!wanted) return;
  const line = view.state.doc.line(Math.min(Math.max(wanted.line, 1), view.state.doc.lines));
  const at = Math.min(line.from + Math.max(wanted.column - 1, 0), line.to);
  wanted = null;
  view.dispatch({ selection: { anchor: at }, effects: EditorView.scrollIntoView(at, { y: "center" }) });
  view.focus();
}

function diagnostics(view: EditorView, complaints: readonly Complaint[]): Diagnostic[] {
  return complaints
    .filter((one) => one.line > 0 && one.line <= view.state.doc.lines)
    .map((one) => {
      const line = view.state.doc.line(one.line);
      const from = Math.min(line.from + Math.max(one.column - 1, 0), line.to);
      return { from, to: Math.min(from + Math.max(one.length, 1), line.to), severity: one.severity, message: one.hint ? `${one.message}\n→ ${one.hint}` : one.message };
    });
}

function sameText(view: EditorView, text: string): void {
  const now = view.state.doc.toString();
  if (now === text) return;
  let start = 0;
  while (start < Math.min(now.length, text.length) && now[start] === text[start]) start++;
  let end = 0;
  while (end < Math.min(now.length, text.length) - start && now[now.length - 1 - end] === text[text.length - 1 - end]) end++;
  view.dispatch({ changes: { from: start, to: now.length - end, insert: text.slice(start, text.length - end) }, annotations: FromDrawing.of(true) });
}

// Shows in the text what is selected in the drawing.
function showSelected(view: EditorView): void {
  const thing = studio.get().selection[0];
  if (!thing || view.hasFocus) return;
  const path = thing.kind === "marker" ? ["body", thing.name.split(".")[0]!] : [thing.kind, thing.name];
  const node = nodeAt(studio.get().model.document.root, path);
  if (!node || node.to > view.state.doc.length) return;
  view.dispatch({ selection: { anchor: node.from, head: node.kind === "table" && node.form === "header" ? node.to : node.from }, effects: EditorView.scrollIntoView(node.from, { y: "start", yMargin: 60 }) });
}

function start(home: HTMLElement): EditorView {
  const history = [
    { key: "Mod-z", run: () => (undo(), true) },
    { key: "Mod-y", run: () => (redo(), true) },
    { key: "Mod-Shift-z", run: () => (redo(), true) },
    { key: "Escape", run: (view: EditorView) => (view.contentDOM.blur(), true) },
  ];
  return new EditorView({
    parent: home,
    state: EditorState.create({
      doc: studio.get().history.text,
      extensions: [
        lineNumbers(),
        lintGutter(),
        drawSelection(),
        highlightActiveLine(),
        bracketMatching(),
        highlightSelectionMatches(),
        StreamLanguage.define(toml),
        syntaxHighlighting(colours),
        autocompletion({ override: [(context: CompletionContext) => complete(context)] }),
        keymap.of([...history, ...completionKeymap, ...searchKeymap, ...defaultKeymap, indentWithTab]),
        EditorView.contentAttributes.of({ "aria-label": "Text of the model", spellcheck: "false", tabindex: "0" }),
        EditorView.updateListener.of((update) => {
          if (!update.docChanged || update.transactions.some((one) => one.annotation(FromDrawing))) return;
          const changes: { from: number; to: number; inserted: string }[] = [];
          update.changes.iterChanges((from, to, _from, _to, text) => changes.push({ from, to, inserted: text.toString() }));
          editText(update.state.doc.toString(), "Edit the text", typing.key(performance.now(), changes));
        }),
      ],
    }),
  });
}

export function TextEditor() {
  const home = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (!home.current) return;
    const view = start(home.current);
    shown = view;
    let complaints = studio.get().complaints;
    let selection = studio.get().selection;
    view.dispatch(setDiagnostics(view.state, diagnostics(view, complaints)));
    showSelected(view);
    goToWanted(view);
    const end = studio.subscribe(() => {
      const now = studio.get();
      sameText(view, now.history.text);
      if (now.complaints !== complaints) {
        complaints = now.complaints;
        view.dispatch(setDiagnostics(view.state, diagnostics(view, complaints)));
      }
      if (now.selection !== selection) {
        selection = now.selection;
        showSelected(view);
      }
    });
    return () => {
      end();
      view.destroy();
      shown = null;
    };
  }, []);
  return <div className="editor" ref={home} />;
}
