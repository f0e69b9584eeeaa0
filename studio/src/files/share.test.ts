import { place } from "../../tests/page";
import { beforeEach, describe, expect, it, vi } from "vitest";
import { edit, openText } from "../actions";
import { EMPTY_MODEL } from "../model/operations";
import { studio } from "../state";
import { encodeModel, followAddress, openFromAddress, shareLink } from "./share";

const model = (name: string) => `${EMPTY_MODEL}# ${name}\n`;
const said = () => studio.get().toasts.at(-1)?.text ?? "";

describe("a link and the page's address", () => {
  beforeEach(() => {
    place.hash = "";
    place.hostname = "studio.example";
    openText(model("mine"), "a.toml");
  });

  it("leaves the address alone where the link is copied", async () => {
    const writeText = vi.fn(async () => undefined);
    vi.stubGlobal("navigator", { clipboard: { writeText } });
    await shareLink();
    expect(writeText).toHaveBeenCalledWith(expect.stringContaining("#m="));
    expect([place.hash, said()]).toEqual(["", expect.stringMatching(/Anyone who opens it/)]);
    place.hostname = "127.0.0.1";
    await shareLink();
    expect(said()).toMatch(/on this computer/);
  });

  it("has the link in the address until the next change where it is not copied", async () => {
    vi.stubGlobal("navigator", {});
    await shareLink();
    expect(place.hash).toMatch(/^#m=/);
    edit(model("changed"), "Edit");
    expect(place.hash).toBe("");
  });

  it("opens a link once: a reload keeps what was done since", async () => {
    place.hash = `#m=${await encodeModel(model("theirs"))}`;
    expect(await openFromAddress()).toBe(true);
    expect([place.hash, studio.get().history.text]).toEqual(["", model("theirs")]);
    edit(model("changed"), "Edit");
    expect(await openFromAddress()).toBe(false);
    expect(studio.get().history.text).toBe(model("changed"));
  });

  it("begins anew at the address of another session of pintle studio", () => {
    place.hash = "#token=0af3";
    followAddress();
    expect(place.reload).toHaveBeenCalledOnce();
  });
});
