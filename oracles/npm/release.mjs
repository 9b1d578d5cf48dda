// Another release of a package than the one its adapter was written against. Its interface may differ: a function may
// be missing, take other arguments or return other fields. A difference must never pass for a wrong answer of the
// engine, so each question is tried first on two balls whose answers are known, and is unsupported where it fails.
/** NAME@RELEASE as the harness names the engine; empty for the release that the adapter was written against. */
export const other_release = process.env.TOUCHSTONE_ENGINE || "";

/** Calls `say_to` for each message, with the bytes that follow it (of a batch). From now on, an error ends the process. */
export function answer_for(say_to) {
  if (other_release) process.setUncaughtExceptionCaptureCallback(null);
  listen(say_to);
}
const newline = 10;
function listen(say_to) {
  let rest = Buffer.alloc(0), message = null;
  const next_line = () => {
    const end = rest.indexOf(newline);
    if (end < 0) return false;
    message = JSON.parse(rest.toString("utf8", 0, end));
    rest = rest.subarray(end + 1);
    return true;
  };
  process.stdin.on("data", (part) => {
    rest = Buffer.concat([rest, part]);
    while (message || next_line()) {
      const wanted = message.ask_many ? message.bytes : 0;
      if (rest.length < wanted) return;
      const [complete, bytes] = [message, rest.subarray(0, wanted)];
      [message, rest] = [null, rest.subarray(wanted)];
      say_to(complete, bytes);
    }
  });
}

/** Whether the error says that the release has no such class, function or type of argument. */
export const is_of_interface = (why) =>
  why instanceof TypeError && /is not a (function|constructor)|is undefined|BigInt|of (undefined|null)/.test(why.message);

const still = [0, 0, 0], upright = [0, 0, 0, 1];
const radius = 1, speed = 4, near = 1.5, within = 2.25, far = 3; // of the centres, along x

const margin = 0.5;

function two_balls(distance) {
  const poses = [0, distance].map((x) => ({ translation: [x, 0, 0], rotation: upright }));
  return {
    shapes: [{ type: "sphere", radius }],
    bodies: poses.map((pose, k) => ({
      shape: 0, static: false, group: -1, pose, motion: { linear: k === 0 ? still : [-speed, 0, 0], angular: still },
    })),
    steps: [...poses.map((pose, body) => ({ op: "insert", body, pose })), { op: "query" }],
    ignored: [],
    margin,
  };
}

// Far wider than any margin or tolerance of an engine, far narrower than the effect of an argument taken for another.
const allowed = 0.15;
const is = (x, truth) => typeof x === "number" && Math.abs(x - truth) <= allowed;
const is_x = (v) => Array.isArray(v) && is(v[0], 1) && is(v[1], 0) && is(v[2], 0);
const pairs_are = (answer, count) => Array.isArray(answer.pairs) && answer.pairs.length === 1 && answer.pairs[0].length === count;
const is_contact = (distance) => (r) =>
  r.overlap === true && (!r.normal || is_x(r.normal)) && (r.depth === undefined || is(r.depth, 2 * radius - distance));

// By question: the distance of the centres, and whether the answer is right.
const trials = {
  overlap: [[near, (r) => r.overlap === true], [far, (r) => r.overlap === false]],
  distance: [[near, (r) => is(r.distance, near - 2 * radius)], [far, (r) => is(r.distance, far - 2 * radius)]],
  contact: [[near, is_contact(near)], [far, (r) => r.overlap === false]],
  time_of_impact: [[far, (r) => is(r.toi, (far - 2 * radius) / speed)], [near, (r) => r.toi === 0]],
  candidates: [[near, (r) => pairs_are(r, 1)]],
  within: [[near, (r) => r.overlap === true], [far, (r) => r.overlap === false]],
  bounded_distance: [[near, (r) => is(r.distance, near - 2 * radius)],
    [far, (r) => is(r.distance ?? r.lower, far - 2 * radius) || is(r.lower, margin)]],
  contact_within: [[near, is_contact(near)], [within, is_contact(within)], [far, (r) => r.overlap === false]],
  scene_contacts: [[near, (r) => Array.isArray(r.contacts) && r.contacts.length === 1]],
};

function why_it_fails(engine, question, guarded) {
  for (const [distance, right] of trials[question]) {
    const scene = two_balls(distance);
    const loaded = guarded(() => (engine.load(scene), {}));
    const answer = loaded.outcome ? loaded : guarded(() => engine[question]({ ask: question, a: 0, b: 1 }, scene));
    if (answer.outcome) return answer.detail;
    if (!right(answer)) return `unit balls ${distance} apart: ${JSON.stringify(answer)}`;
  }
  return "";
}

/** The questions whose trial fails, with the reason; null if the release crashed, after which it answers no question. */
export function questions_that_fail(engine, guarded) {
  const fails = new Map();
  for (const question of Object.keys(trials)) {
    if (!engine[question]) continue;
    let why;
    try {
      why = why_it_fails(engine, question, guarded);
    } catch (crash) {
      refuse_all(crash);
      return null;
    }
    if (why) fails.set(question, `${other_release} differs from the adapter's release: ${why}`);
  }
  return fails;
}

// The release cannot even be started: it says so to every question, whatever else it throws.
function refuse_all(why) {
  process.setUncaughtExceptionCaptureCallback(null);
  process.setUncaughtExceptionCaptureCallback(() => {});
  const first_line = String(why.message || why).split("\n")[0].slice(0, 200);
  const detail = `${other_release} cannot be started by the adapter: ${first_line}`;
  const [name, release] = [other_release, other_release.slice(other_release.lastIndexOf("@") + 1)];
  const say = (answer) => process.stdout.write(JSON.stringify(answer) + "\n");
  say({ touchstone_pipe: 1, receipts: true, name, library: name, version: release, settings: detail, unit_roundoff: 2 ** -24,
        tau_factor: 1, source: "" });
  listen(() => say({ outcome: "unsupported", detail }));
}
// Not an event's listener, beside which modules made by Emscripten put their own.
if (other_release) process.setUncaughtExceptionCaptureCallback(refuse_all);
