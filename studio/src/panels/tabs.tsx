// A row of tabs with arrow keys, as screen readers expect; choosing the active tab again closes its panel.
import { useRef } from "react";
import { Icon } from "./icons";

interface Props<T extends string> {
  label: string;
  tabs: readonly { id: T; label: string; badge?: string; alarming?: boolean }[];
  active: T | null;
  panel: string;
  onChoose: (id: T) => void;
  onClose: () => void;
  children?: React.ReactNode;
}

export function TabList<T extends string>({ label, tabs, active, panel, onChoose, onClose, children }: Props<T>) {
  const row = useRef<HTMLDivElement>(null);
  const key = (event: React.KeyboardEvent) => {
    const step = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    if (!step) return;
    const here = tabs.findIndex((one) => one.id === active);
    const next = tabs[(here + step + tabs.length) % tabs.length]!;
    onChoose(next.id);
    row.current?.querySelectorAll<HTMLElement>("[role=tab]")[tabs.indexOf(next)]?.focus();
    event.preventDefault();
  };
  return (
    <div className="tabs">
      <div role="tablist" aria-label={label} ref={row} onKeyDown={key}>
        {tabs.map((one, i) => (
          <button key={one.id} role="tab" aria-selected={one.id === active} aria-controls={one.id === active ? panel : undefined} tabIndex={one.id === active || (!active && i === 0) ? 0 : -1} className={one.id === active ? "tab active" : "tab"} onClick={() => onChoose(one.id)}>
            {one.label}
            {one.badge && <span className={one.alarming ? "badge alarming" : "badge"}>{one.badge}</span>}
          </button>
        ))}
      </div>
      {children}
      {active && (
        <button className="icon-button small" aria-label={`Close ${label.toLowerCase()}`} onClick={onClose}>
          <Icon name="close" size={16} />
        </button>
      )}
    </div>
  );
}
