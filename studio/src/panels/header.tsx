// The page header: the model's name, files, undo, the palette, help.
import { useEffect, useState } from "react";
import { edit, redo, undo } from "../actions";
import { runCommand } from "../commands";
import { Draft } from "../model/edit";
import { studio, useStudio } from "../state";
import { Icon } from "./icons";
import { Menu } from "./menu";

export function Header() {
  const canUndo = useStudio((now) => now.history.past[now.history.past.length - 1]?.label ?? "");
  const canRedo = useStudio((now) => now.history.future[0]?.label ?? "");
  const theme = useStudio((now) => now.theme);
  return (
    <header className="head">
      <h1 className="brand">
        <svg width="26" height="26" viewBox="0 0 26 26" aria-hidden="true">
          <path className="brand-bar" d="M5.500 20.500L20.500 5.500" />
          <circle className="brand-pin" cx="6" cy="20" r="3.600" />
          <circle className="brand-pin" cx="20" cy="6" r="3.600" />
        </svg>
        Pintle<span className="visually-hidden"> Studio</span>
      </h1>
      <Name />
      <div className="head-group" role="group" aria-label="File">
        <button className="text-button" onClick={() => runCommand("gallery")}>
          <Icon name="gallery" size={18} /> Templates
        </button>
        <button className="text-button" onClick={() => runCommand("open")}>
          <Icon name="open" size={18} /> Open
        </button>
        <button className="text-button" onClick={() => runCommand("save")}>
          <Icon name="save" size={18} /> Save
        </button>
        <Menu label="Export" icon="export" items={["save-as", "share", "export-report", "export-csv", "export-svg", "export-gif"]} />
      </div>
      <div className="head-group" role="group" aria-label="Undo">
        <button className="icon-button" aria-label="Undo" data-tip={canUndo ? `Undo: ${canUndo}` : "Nothing to undo"} disabled={!canUndo} onClick={undo}>
          <Icon name="undo" />
        </button>
        <button className="icon-button" aria-label="Redo" data-tip={canRedo ? `Redo: ${canRedo}` : "Nothing to redo"} disabled={!canRedo} onClick={redo}>
          <Icon name="redo" />
        </button>
      </div>
      <span className="head-space" />
      <button className="search-button" onClick={() => runCommand("palette")}>
        <Icon name="search" size={16} /> Find a command <kbd>Ctrl K</kbd>
      </button>
      <button className="icon-button" aria-label={theme === "dark" ? "Light" : "Dark"} data-tip="Dark or light" onClick={() => runCommand("theme")}>
        <Icon name={theme === "dark" ? "sun" : "moon"} />
      </button>
      <button className="icon-button" aria-label="Help and keys" data-tip="Help  ?" onClick={() => runCommand("help")}>
        <Icon name="help" />
      </button>
    </header>
  );
}

function Name() {
  const name = useStudio((now) => now.model.name);
  const unsaved = useStudio((now) => now.history.text !== now.savedText);
  const file = useStudio((now) => now.fileName);
  const [typed, setTyped] = useState(name);
  useEffect(() => setTyped(name), [name]);
  const commit = () => {
    if (typed !== name && !edit(new Draft(studio.get().history.text).set(["name"], typed).apply(), "Rename the model")) setTyped(name);
  };
  return (
    <span className="name">
      <input aria-label="Name of the model" value={typed} spellCheck={false} onChange={(event) => setTyped(event.target.value)} onBlur={commit} onKeyDown={(event) => event.key === "Enter" && event.currentTarget.blur()} />
      <span className="file" title={unsaved ? "Stored in this browser, not saved as a file" : "Saved"}>
        {file}
        {unsaved && <span className="dot" aria-label="not saved as a file" role="img" />}
      </span>
    </span>
  );
}
