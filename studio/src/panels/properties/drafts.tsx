// Unsaved work of other tabs, stored in this browser.
import { useState } from "react";
import { forgetDraft, openDraft, otherDrafts } from "../../files/autosave";
import { draftName } from "../../files/drafts";
import { studio } from "../../state";
import { Dialog } from "../dialog";
import { Icon } from "../icons";

export function DraftsDialog() {
  const [drafts, setDrafts] = useState(otherDrafts);
  const open = (id: string) => {
    studio.set({ dialog: null });
    openDraft(id);
  };
  return (
    <Dialog title="Unsaved work of other tabs">
      {drafts.length === 0 && <p className="quiet">There is none. This tab's work is on the drawing.</p>}
      <ul className="things">
        {drafts.map((one) => (
          <li key={one.id} className="point-row">
            <button onClick={() => open(one.id)}>
              <span>{draftName(one)}</span>
              <span className="about">{new Date(one.time).toLocaleString()}</span>
            </button>
            <button
              className="icon-button small"
              aria-label={`Discard ${draftName(one)}`}
              data-tip="Discard permanently"
              onClick={() => {
                forgetDraft(one.id);
                setDrafts(otherDrafts());
              }}
            >
              <Icon name="trash" size={17} />
            </button>
          </li>
        ))}
      </ul>
    </Dialog>
  );
}
