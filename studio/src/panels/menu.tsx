// A small menu of commands under a button.
import { useEffect, useRef, useState } from "react";
import { COMMANDS, printChord, runCommand } from "../commands";
import { Icon } from "./icons";

export function Menu({ label, icon, items }: { label: string; icon: string; items: readonly string[] }) {
  const [open, setOpen] = useState(false);
  const root = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (!open) return;
    root.current?.querySelector<HTMLElement>("[role=menuitem]")?.focus();
    const away = (event: PointerEvent) => !root.current?.contains(event.target as Node) && setOpen(false);
    window.addEventListener("pointerdown", away);
    return () => window.removeEventListener("pointerdown", away);
  }, [open]);
  const move = (step: number) => {
    const all = [...(root.current?.querySelectorAll<HTMLElement>("[role=menuitem]") ?? [])];
    all[(all.indexOf(document.activeElement as HTMLElement) + step + all.length) % all.length]?.focus();
  };
  const key = (event: React.KeyboardEvent) => {
    if (!open) return;
    if (event.key === "Escape") setOpen(false);
    else if (event.key === "ArrowDown") move(1);
    else if (event.key === "ArrowUp") move(-1);
    else return;
    event.preventDefault();
    event.stopPropagation();
  };
  return (
    <div className="menu" ref={root} onKeyDown={key}>
      <button className="text-button" aria-haspopup="menu" aria-expanded={open} onClick={() => setOpen(!open)}>
        <Icon name={icon} size={18} /> {label} <Icon name="chevron" size={14} />
      </button>
      {open && (
        <div className="menu-list" role="menu" aria-label={label}>
          {items.map((id) => {
            const command = COMMANDS.find((one) => one.id === id);
            if (!command) return null;
            return (
              <button
                key={id}
                role="menuitem"
                onClick={() => {
                  setOpen(false);
                  runCommand(id);
                }}
              >
                {command.label}
                {command.keys[0] && <kbd>{printChord(command.keys[0])}</kbd>}
              </button>
            );
          })}
        </div>
      )}
    </div>
  );
}
