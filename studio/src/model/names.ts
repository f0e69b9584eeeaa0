// Names for new things: letters for points as in a textbook, numbered words for the rest.
import type { Model } from "./model";

export type Kind = "body" | "joint" | "spring" | "torsion_spring" | "force" | "motor";

export function namesOf(model: Model, kind: Kind): Set<string> {
  switch (kind) {
    case "body":
      return new Set([...model.bodies.map((body) => body.name), "ground"]);
    case "joint":
      return new Set(model.joints.map((joint) => joint.name));
    case "spring":
      return new Set(model.springs.filter((spring) => !spring.torsion).map((spring) => spring.name));
    case "torsion_spring":
      return new Set(model.springs.filter((spring) => spring.torsion).map((spring) => spring.name));
    case "force":
      return new Set(model.loads.map((load) => load.name));
    case "motor":
      return new Set(model.motors.map((motor) => motor.name));
  }
}

/** "link1", "link2", ... */
export function countedName(word: string, taken: ReadonlySet<string>): string {
  for (let i = 1; ; i++) if (!taken.has(`${word}${i}`)) return `${word}${i}`;
}

/** The word itself if it is free, else the word with a number. */
export function freshName(word: string, taken: ReadonlySet<string>): string {
  if (!taken.has(word)) return word;
  for (let i = 2; ; i++) if (!taken.has(`${word}_${i}`)) return `${word}_${i}`;
}

/** The next letter of the drawing: A, B, ..., Z, A1, B1, ... */
export function nextLetter(taken: ReadonlySet<string>): string {
  for (let round = 0; ; round++) {
    for (let i = 0; i < 26; i++) {
      const letter = String.fromCharCode(65 + i) + (round || "");
      if (!taken.has(letter)) return letter;
    }
  }
}

/** Names of all markers and joints, so that a letter stands for only one point of the drawing. */
export function lettersOf(model: Model): Set<string> {
  const letters = new Set(model.joints.map((joint) => joint.name));
  for (const marker of model.ground) letters.add(marker.name);
  for (const body of model.bodies) for (const marker of body.markers) letters.add(marker.name);
  return letters;
}

export const NAME = /^[A-Za-z0-9_-]+$/;
