// The models of the folder that `pintle studio` was started in.
import { openFromFolder } from "../files/folder";
import { pickFile } from "../files/disk";
import { studio, useStudio } from "../state";
import { Dialog } from "./dialog";
import { Icon } from "./icons";

export function FolderDialog() {
  const folder = useStudio((now) => now.folder);
  return (
    <Dialog title={`Open from ${folder?.name ?? "the folder"}`}>
      {folder?.models.length === 0 && <p className="quiet">There are no models in this folder yet.</p>}
      <ul className="things">
        {folder?.models.map((one) => (
          <li key={one.path}>
            <button onClick={() => void openFromFolder(one.path)}>
              <span>{one.path}</span>
              <span className="about">{Math.max(1, Math.round(one.size / 1024))} kB</span>
            </button>
          </li>
        ))}
      </ul>
      <p className="dialog-foot">
        <button
          className="button"
          onClick={() => {
            studio.set({ dialog: null });
            void pickFile();
          }}
        >
          <Icon name="open" size={17} /> Another file on this computer
        </button>
      </p>
    </Dialog>
  );
}
