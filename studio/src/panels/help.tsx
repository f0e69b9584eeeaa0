// The help sheet: the concept in half a page, and all keys.
import { COMMANDS, printChord } from "../commands";
import { Dialog } from "./dialog";

const GROUPS = ["Draw", "Play", "Edit", "View", "File", "Help"] as const;

export function Help() {
  return (
    <Dialog title="Help" wide>
      <div className="help-idea">
        <p>
          In Pintle a joint is a <b>force law</b>: a pin is a very stiff spring, a bushing a soft one. So every joint force is known at all times, even where links are redundant or collinear.
        </p>
        <ul>
          <li>
            <b>Draw:</b> drag a link from end to end; an end placed on another link is pinned there. While dragging, type a length, Tab, an angle. <kbd>⇧</kbd> snaps to 15°, <kbd>Alt</kbd> ignores the grid.
            Without a mouse: arrows move the tool's point along the grid and onto points, <kbd>⇧</kbd> by five, <kbd>Enter</kbd> places it.
          </li>
          <li>
            <b>Move:</b> drag a link and the mechanism follows; drag a point to reshape it. The wheel zooms; drag the background to pan, with the middle or right button in any tool.
          </li>
          <li>
            <b>Play:</b> you see the computed run. Drag a link while it plays: a soft spring pulls it, live. Arrows are the joint forces on each joint's second link; their length is proportional to the square root of the force.
          </li>
          <li>
            <b>Read:</b> click a plot to go to that time. Each peak force has an error estimate.
          </li>
          <li>
            <b>Keep:</b> every tab is restored as you left it. Saving writes to the file the model came from; a new model needs a name.
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
