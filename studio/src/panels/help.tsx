// The help sheet: the idea on half a page, and every key.
import { COMMANDS, printChord } from "../commands";
import { Dialog } from "./dialog";

const GROUPS = ["Draw", "Play", "Edit", "View", "File", "Help"] as const;

export function Help() {
  return (
    <Dialog title="Help" wide>
      <div className="help-idea">
        <p>
          In Pintle a joint is a <b>force law</b>: a pin is a very stiff spring, a bushing a soft one. So every joint's force is known at every moment, also where links are redundant or in line.
        </p>
        <ul>
          <li>
            <b>Draw:</b> drag a link from end to end; an end on another link is pinned there. While you drag, type a length, Tab, an angle. <kbd>⇧</kbd> keeps to 15°, <kbd>Alt</kbd> leaves the grid.
            Without a mouse: arrows move the tool's point from grid line to grid line and onto points, <kbd>⇧</kbd> by five, <kbd>Enter</kbd> sets it.
          </li>
          <li>
            <b>Move:</b> drag a link and the mechanism follows; drag a point and it changes its shape. Wheel zooms, dragging the paper moves it; the middle or right button does so with any tool.
          </li>
          <li>
            <b>Play:</b> what you see is the computed run. Drag a link while it plays: a soft spring pulls it, live. Arrows are joint forces on the link that a joint names second; their length grows as the root of the force.
          </li>
          <li>
            <b>Read:</b> click a plot and the mechanism goes there. Each peak force comes with an estimate of its error.
          </li>
          <li>
            <b>Keep:</b> every tab comes back as it was left. Saving writes to the file that the model came from, and asks a new one its name.
          </li>
        </ul>
      </div>
      <div className="help-keys">
        {GROUPS.map((group) => (
          <section key={group}>
            <h3>{group}</h3>
            <dl>
              {COMMANDS.filter((one) => one.group === group && one.keys.length > 0).map((one) => (
                <div key={one.id}>
                  <dt>{one.label.replace("Draw: ", "")}</dt>
                  <dd>
                    {one.keys.map((chord) => (
                      <kbd key={chord}>{printChord(chord)}</kbd>
                    ))}
                  </dd>
                </div>
              ))}
            </dl>
          </section>
        ))}
      </div>
    </Dialog>
  );
}
