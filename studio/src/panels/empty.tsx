// The hints in an empty drawing: three ways to begin.
import { chooseTool } from "../actions";
import { runCommand } from "../commands";
import { otherDrafts } from "../files/autosave";
import { useStudio } from "../state";
import { useMemo } from "react";
import { Icon } from "./icons";

export function EmptyDrawing() {
  const empty = useStudio((now) => now.model.bodies.length === 0 && now.model.ground.length === 0 && now.tool === "select");
  const dialog = useStudio((now) => now.dialog);
  const lost = useMemo(() => empty && otherDrafts().length > 0, [empty]);
  if (!empty || dialog === "gallery") return null;
  return (
    <section className="empty" aria-label="How to begin">
      <h2>Draw a mechanism. Press play. Trust the forces.</h2>
      <ol>
        <li>
          <kbd>L</kbd> draws a <b>link</b>: drag from end to end. Start the next one at its end, and a pin joins them.
        </li>
        <li>
          <kbd>G</kbd> pins a point to the <b>ground</b>; <kbd>M</kbd> puts a <b>motor</b> on a pin.
        </li>
        <li>
          <kbd>Space</kbd> <b>plays</b> it. Every joint shows its force; drag a link while it runs.
        </li>
      </ol>
      <div className="empty-buttons">
        <button className="button primary" onClick={() => chooseTool("link")}>
          <Icon name="link" /> Draw a link
        </button>
        <button className="button" onClick={() => runCommand("gallery")}>
          <Icon name="gallery" /> Start from a template
        </button>
        <button className="button" onClick={() => runCommand("open")}>
          <Icon name="open" /> Open a file
        </button>
        {lost && (
          <button className="button" onClick={() => runCommand("drafts")}>
            <Icon name="undo" /> Unsaved work of other tabs
          </button>
        )}
      </div>
    </section>
  );
}
