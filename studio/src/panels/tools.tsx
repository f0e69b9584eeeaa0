// The toolbar of drawing tools, grouped by what they create.
import { Fragment } from "react";
import { chooseTool } from "../actions";
import { TOOL_LIST, type Tool } from "../drawing/tools";
import { useStudio } from "../state";
import { Icon } from "./icons";

const GROUPS: { name: Tool["group"]; label: string }[] = [
  { name: "select", label: "Select" },
  { name: "bodies", label: "Bodies" },
  { name: "joints", label: "Joints" },
  { name: "loads", label: "Springs and loads" },
];

export function Tools() {
  const tool = useStudio((now) => now.tool);
  return (
    <nav className="tools" aria-label="Drawing tools">
      {GROUPS.map((group, i) => (
        <Fragment key={group.name}>
          {i > 0 && <hr />}
          <div role="group" aria-label={group.label} className={group.name === "loads" ? "tool-group two" : "tool-group"}>
            {TOOL_LIST.filter((one) => one.group === group.name).map((one) => (
              <button key={one.name} className={one.name === tool ? "tool active" : "tool"} aria-pressed={one.name === tool} aria-label={one.label} data-tip={`${one.label}  ${one.key}`} data-tool-name={one.name} onClick={() => chooseTool(one.name)}>
                <Icon name={one.name} />
              </button>
            ))}
          </div>
        </Fragment>
      ))}
    </nav>
  );
}
