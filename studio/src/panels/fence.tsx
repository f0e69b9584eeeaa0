// A fault in one panel does not affect the others or the model.
import { Component, type ReactNode } from "react";

export class Fence extends Component<{ of: string; children: ReactNode }, { fault: string | null }> {
  override state = { fault: null as string | null };

  static getDerivedStateFromError(error: unknown): { fault: string } {
    return { fault: error instanceof Error ? error.message : String(error) };
  }

  override render(): ReactNode {
    if (this.state.fault === null) return this.props.children;
    return (
      <section className="fence" role="alert">
        <h2>The {this.props.of} stopped</h2>
        <p>Your model is kept. Undo the last step, or try again; if it happens again, save the file and report it.</p>
        <p className="mono">{this.state.fault}</p>
        <button className="button" onClick={() => this.setState({ fault: null })}>
          Try again
        </button>
      </section>
    );
  }
}
