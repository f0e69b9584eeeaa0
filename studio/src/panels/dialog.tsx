// A dialog: the browser's own, which traps the focus and closes on Escape.
import { type ReactNode, useEffect, useRef } from "react";
import { studio } from "../state";
import { Icon } from "./icons";

export function Dialog({ title, wide = false, children }: { title: string; wide?: boolean; children: ReactNode }) {
  const element = useRef<HTMLDialogElement>(null);
  useEffect(() => {
    const dialog = element.current;
    if (!dialog || dialog.open) return;
    dialog.showModal();
    (dialog.querySelector<HTMLElement>("input") ?? dialog).focus();
  }, []);
  const close = () => studio.set({ dialog: null });
  return (
    <dialog
      ref={element}
      tabIndex={-1}
      className={wide ? "dialog wide" : "dialog"}
      aria-label={title}
      onClose={close}
      onCancel={close}
      onPointerDown={(event) => event.target === element.current && close()}
    >
      <div className="dialog-body">
        <header className="dialog-head">
          <h2>{title}</h2>
          <button className="icon-button" aria-label="Close" onClick={close}>
            <Icon name="close" />
          </button>
        </header>
        {children}
      </div>
    </dialog>
  );
}
