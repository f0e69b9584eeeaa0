// The name of a file that is saved for the first time, or again under another name.
import { useState } from "react";
import { saveUnder } from "../files/disk";
import { studio, useStudio } from "../state";
import { Dialog } from "./dialog";
import { Icon } from "./icons";

export function SaveDialog() {
  const folder = useStudio((now) => now.folder);
  const [name, setName] = useState(studio.get().fileName);
  const save = () => {
    studio.set({ dialog: null });
    void saveUnder(name);
  };
  return (
    <Dialog title={folder ? `Save in ${folder.name}` : "Save as a file"}>
      <form
        onSubmit={(event) => {
          event.preventDefault();
          save();
        }}
      >
        <div className="field">
          <label htmlFor="save-name">File name</label>
          <span className="quantity">
            <input id="save-name" value={name} spellCheck={false} required onFocus={(event) => event.target.setSelectionRange(0, name.replace(/\.toml$/, "").length)} onChange={(event) => setName(event.target.value)} />
          </span>
        </div>
        <p className="dialog-foot">
          <button className="button primary" type="submit">
            <Icon name="save" size={17} /> Save the file
          </button>
        </p>
      </form>
    </Dialog>
  );
}
