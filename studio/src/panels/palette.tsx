// Finds a command, or a thing of the model, by some of its letters.
import { useState } from "react";
import { select } from "../actions";
import { COMMANDS, printChord } from "../commands";
import { studio, useStudio } from "../state";
import { Dialog } from "./dialog";

interface Item {
  label: string;
  about: string;
  run: () => void;
}

export function Palette() {
  const [sought, setSought] = useState("");
  const [at, setAt] = useState(0);
  const model = useStudio((now) => now.model);
  const words = sought.toLowerCase().split(/\s+/).filter(Boolean);
  const all: Item[] = [
    ...COMMANDS.map((one) => ({ label: one.label, about: one.keys[0] ? printChord(one.keys[0]) : one.group, run: one.run })),
    ...model.bodies.map((one) => ({ label: `Go to link ${one.name}`, about: "link", run: () => select([{ kind: "body", name: one.name }]) })),
    ...model.joints.map((one) => ({ label: `Go to joint ${one.name}`, about: one.type, run: () => select([{ kind: "joint", name: one.name }]) })),
  ];
  const found = all.filter((one) => words.every((word) => one.label.toLowerCase().includes(word))).slice(0, 14);
  const choose = (item: Item | undefined) => {
    if (!item) return;
    studio.set({ dialog: null });
    item.run();
  };
  const key = (event: React.KeyboardEvent) => {
    if (event.key === "ArrowDown") setAt(Math.min(at + 1, found.length - 1));
    else if (event.key === "ArrowUp") setAt(Math.max(at - 1, 0));
    else if (event.key === "Enter") choose(found[at]);
    else return;
    event.preventDefault();
  };
  return (
    <Dialog title="Find a command">
      <input
        className="palette-input"
        role="combobox"
        aria-expanded="true"
        aria-controls="palette-list"
        aria-activedescendant={found[at] ? `palette-${at}` : undefined}
        aria-label="Command"
        placeholder="Type a command"
        autoFocus
        value={sought}
        onChange={(event) => {
          setSought(event.target.value);
          setAt(0);
        }}
        onKeyDown={key}
      />
      <ul className="palette-list" role="listbox" id="palette-list" aria-label="Commands">
        {found.map((one, i) => (
          <li key={one.label} id={`palette-${i}`} role="option" aria-selected={i === at} className={i === at ? "active" : ""} onPointerEnter={() => setAt(i)} onClick={() => choose(one)}>
            <span>{one.label}</span>
            <kbd>{one.about}</kbd>
          </li>
        ))}
      </ul>
      {found.length === 0 && <p className="quiet">No matching command.</p>}
    </Dialog>
  );
}
