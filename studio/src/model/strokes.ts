// Keystrokes that form one undo step: those that continue where the last one was, without a pause.

/** Longer than between two keystrokes, shorter than a pause for thought [ms]. */
const PAUSE = 1000;

export class Strokes {
  private count = 0;
  private last = Number.NEGATIVE_INFINITY;

  constructor(private readonly word: string) {}

  /** The key of the step to which a stroke belongs. */
  key(now: number, goesOn: boolean): string {
    if (!goesOn || now - this.last > PAUSE) this.count++;
    this.last = now;
    return `${this.word}${this.count}`;
  }

  /** The next stroke starts a new step. */
  end(): void {
    this.last = Number.NEGATIVE_INFINITY;
  }
}

interface TextChange {
  /** The range that was replaced, in the previous text. */
  from: number;
  to: number;
  inserted: string;
}

/** Typing in a text: a line, or what is typed in one place, is a step. */
export class Typing {
  private readonly strokes = new Strokes("typing");
  private cursor = -1;

  key(now: number, changes: readonly TextChange[]): string {
    const only = changes.length === 1 ? changes[0] : undefined;
    const key = this.strokes.key(now, only !== undefined && (only.from === this.cursor || only.to === this.cursor));
    this.cursor = only ? only.from + only.inserted.length : -1;
    if (!only || only.inserted.includes("\n")) this.strokes.end();
    return key;
  }
}
