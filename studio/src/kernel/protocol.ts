// The messages between the page and the kernel in its worker. Keys in JSON are those of the C++ code; SI and radians
// throughout. Version 1.

/** An error for the user: what is wrong, what to try, and where. */
export interface Fault {
  message: string;
  hint: string;
  /** Set on the page's side of the kernel. missing: there is no kernel; ended: the call was ended without an answer, along with its worker. */
  kind?: "missing" | "ended";
  where?: { line: number; column: number; key: string };
  /** All complaints about the model, if it is the cause. */
  complaints?: Complaint[];
  /** Joints that are involved. */
  joints?: string[];
}

/** A remark about a place in a text. Line and column count from 1 (characters, not bytes); 0: unknown. */
export interface Complaint {
  severity: "error" | "warning";
  line: number;
  column: number;
  /** Number of characters concerned, from the column on; at least 1. */
  length: number;
  /** The key in the model: "joint.A.stiffness". */
  key: string;
  /** What was found, and why it is wrong. */
  message: string;
  /** What to try; may be empty. */
  hint: string;
}

/** The model as a tree, as `pintle convert --to json` writes it: quantities may be strings with units. */
export type ModelTree = { [key: string]: TreeValue };
export type TreeValue = string | number | boolean | TreeValue[] | { [key: string]: TreeValue };

export interface Marker {
  name: string;
  /** In body axes, from the centre of mass [m]. */
  position: [number, number];
  /** Direction of the marker's x axis in body axes [rad]. */
  axis: number;
}

/** The same model with every expression evaluated, as needed for drawing. Poses are those stated by the model. */
export interface ResolvedModel {
  name: string;
  description: string;
  gravity: [number, number];
  duration: number;
  output_step: number;
  tolerance: number;
  method: string;
  equations: string;
  start: string;
  ground: Marker[];
  bodies: {
    name: string;
    mass: number;
    inertia: number;
    position: [number, number] | null;
    angle: number | null;
    markers: Marker[];
  }[];
  joints: {
    name: string;
    type: string;
    first: { body: string; marker: string };
    second: { body: string; marker: string };
    geometry: Record<string, number>;
    law: { word: string; values: Record<string, number[]> };
    ideal: boolean;
  }[];
  springs: {
    name: string;
    torsion: boolean;
    first: { body: string; marker: string };
    second: { body: string; marker: string };
    stiffness: number;
    damping: number;
    free_length: number | null;
    preload: number | null;
  }[];
  forces: { name: string; on: { body: string; marker: string }; force: [string, string]; torque: string; body_axes: boolean }[];
  motors: { name: string; joint: string; kind: "effort" | "speed" | "position"; law: string; stiffness: number; damping: number }[];
}

export interface ReadAnswer {
  ok: boolean;
  /** The tree, if the text is valid TOML or JSON. */
  model?: ModelTree;
  /** If the model is valid. */
  resolved?: ResolvedModel;
  complaints: Complaint[];
}

export interface TextAnswer {
  ok: boolean;
  text?: string;
  complaints: Complaint[];
}

/** One key of the model format. */
export interface CatalogKey {
  name: string;
  /** SI unit of the value: "N/m", "-" for a pure number. */
  unit: string;
  /** The unit in joints whose free coordinate is an angle, if it differs. */
  angular_unit?: string;
  meaning: string;
  /** If absent, the key must be stated or is determined in another way. */
  default?: number | string;
  /** What an absent key means, if that is not a number. */
  otherwise?: string;
  /** Smallest accepted value. */
  minimum?: number;
  /** The key must be one of these words. */
  words?: string[];
  /** A list of any length. */
  list?: boolean;
}

/** Joint types and laws, with the data for forms. */
export interface Catalog {
  joint_types: {
    word: string;
    meaning: string;
    /** Free coordinates: "angle", "slide". */
    free: string[];
    /** What it constrains, in the order of a law's components. */
    gap: string[];
    geometry: CatalogKey[];
    laws: string[];
  }[];
  laws: { word: string; meaning: string; /** The key of a joint that chooses it. */ role: "law" | "friction" | "stops" | "detent"; keys: CatalogKey[] }[];
  methods: string[];
}

/** The output of `pintle check --json`, with advice. */
export interface CheckReport {
  passed: boolean;
  bodies: number;
  joints: number;
  total_mass: number;
  mass_centre: [number, number];
  topology: { n_loops: number; loops: string[][]; floating: string[][] };
  mobility: {
    freedoms: number;
    constraints: number;
    gruebler: number;
    rank: number;
    rank_nearby: number;
    mobility: number;
    redundant: number;
    servos: number;
    mobility_driven: number;
    singular_position: boolean;
    remark: string;
    [key: string]: unknown;
  };
  redundancies: { degree: number; members: { joint: string; component: string; share: number }[] }[];
  notes: string[];
  /** For the warning panel. */
  warnings: Warning[];
  [key: string]: unknown;
}

export interface Warning {
  kind: "immobile" | "redundant" | "singular" | "floating" | "formula" | "driven" | "note";
  message: string;
  hint: string;
  joints: string[];
  bodies: string[];
}

/** Bodies in the order of the model; `poses` has x, y [m] and angle [rad] of each. */
export interface AssemblyAnswer {
  ok: boolean;
  poses: Float64Array;
  /** Distance by which each joint remains open [m], in the order of the model. */
  gaps: Float64Array;
  /** Why it does not close. */
  reason?: Fault;
}

/** A point of a body (body axes, from the centre of mass) that should be at `target` (world) [m]. */
export interface Hold {
  body: string;
  point: [number, number];
  target: [number, number];
}

export interface Column {
  name: string;
  unit: string;
  about: string;
  kind: "time" | "body" | "joint" | "spring" | "motor" | "energy";
  /** The body, joint, spring or motor; empty for time and energy. */
  of: string;
  /** "x", "angle", "fx", "m", "effort", ... */
  quantity: string;
  /** "world" or "joint" for a force, else "". */
  frame: string;
  /** The body on which the force acts, else "". */
  feels: string;
}

export interface PeakForce {
  name: string;
  type: string;
  first_body: string;
  second_body: string;
  peak: number;
  peak_time: number;
  rms: number;
  mean: number;
  has_moment: boolean;
  peak_moment: number;
  rms_moment: number;
  mean_moment: number;
  error_estimate: number;
  moment_error_estimate: number;
  relative_error_estimate: number;
  /** false: redundant ideal joints leave this force undetermined. */
  unique: boolean;
}

export interface MotorWork {
  name: string;
  joint: string;
  unit: string;
  peak_effort: number;
  rms_effort: number;
  mean_effort: number;
  peak_power: number;
  mean_power: number;
  work: number;
  /** null for an effort that the model gives. */
  effort_error: number | null;
}

export interface EnergyAccount {
  kinetic_start: number;
  kinetic_end: number;
  kinetic_peak: number;
  potential_start: number;
  potential_end: number;
  dissipated: number;
  supplied: number;
  drift: number;
}

/** A pin for which the model states a bearing. Values that are not available are null. */
export interface BearingAnswer {
  joint: string;
  equivalent_load: number;
  /** L10 [h]. */
  life_hours: number;
  static_safety: number;
  peak_pressure: number;
  peak_pv: number;
  /** Missing dimensions, and cases in which the formulas do not hold. */
  wants: string[];
  remarks: string[];
}

export interface RunAnswer {
  outcome: "completed" | "tolerance_not_met" | "interrupted" | "failed" | "horizon" | "runaway" | "energy_open";
  columns: Column[];
  /** One array per column. */
  values: Float64Array[];
  joints: PeakForce[];
  springs: PeakForce[];
  motors: MotorWork[];
  bearings?: BearingAnswer[];
  energy: EnergyAccount;
  counters: Record<string, number>;
  method: string;
  tolerance: number;
  wall_seconds: number;
  t_end: number;
  notes: string[];
  /** Why the outcome is not "completed". */
  message: string;
  /** Why it ended early, and the joints named by the reason. Everything up to that time is in `values`. */
  stopped?: { time: number; joints: string[]; reason: string; hint: string };
}

export interface RunProgress {
  /** Estimated fraction of the whole run; never decreases. */
  fraction: number;
  /** Model time [s] reached in this integration. */
  t: number;
  duration: number;
  /** Integrations of one run: the pilot (1), the reported one (2), finer ones; 0 during assembly. */
  pass: number;
  wall_seconds: number;
  seconds_left: number | null;
}

/** A soft spring between a point of a body and a point of the world. Stiffness 0 or absent: chosen according to the model. */
export interface Pull {
  body: string;
  point: [number, number];
  target: [number, number];
  stiffness?: number;
}

export interface LiveStart {
  bodies: string[];
  joints: string[];
  poses: Float64Array;
  /** A typical force of the mechanism at its start, used for the length of arrows [N]. */
  force_scale: number;
  notes: string[];
}

export interface LiveFrame {
  t: number;
  /** 3 per body: x, y [m], angle [rad]. */
  poses: Float64Array;
  /** 3 per body: vx, vy [m/s], spin [rad/s]. */
  velocities: Float64Array;
  /** 3 per joint: fx, fy [N] (world axes) and couple [N*m] about the second marker, on the second body. */
  joint_forces: Float64Array;
  energy: { kinetic: number; potential: number; dissipated: number; supplied: number };
  /** True if the allowed wall time was not enough for dt: the motion is slower than requested. */
  behind: boolean;
  /** Wall time of the kernel in this call [s]. */
  cost: number;
  /** The motion is stopped because no step was possible. It continues when the pull is released or changed. */
  error: Fault | null;
}
