// node mcap.mjs FOLDER FILE: the joint positions that an MCAP recording holds, as CSV: a row for every message with
// joint states (sensor_msgs/JointState of ROS 1 or 2, or JSON with "name" and "position"), once every joint has been
// stated. FOLDER has node_modules with @mcap/core and @mcap/support. What is wrong with the file: one line on stdout that
// begins with "!".
import { createReadStream } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const [folder, file] = process.argv.slice(2);
const MOST_ROWS = 1_000_000, MOST_JOINTS = 10_000;

class Refused extends Error {}

/** The bytes of a message in ROS' encodings. `aligned`: CDR, whose numbers lie at multiples of their size. */
class Bytes {
  constructor(data, start, littleEndian, aligned) {
    this.view = new DataView(data.buffer, data.byteOffset, data.byteLength);
    Object.assign(this, { start, at: start, littleEndian, aligned });
  }
  take(size, align = size) {
    if (this.aligned) this.at += (align - ((this.at - this.start) % align)) % align;
    const from = this.at;
    this.at += size;
    if (this.at > this.view.byteLength) throw new Refused("a message ends too early");
    return from;
  }
  count() {
    return this.view.getUint32(this.take(4), this.littleEndian);
  }
  number() {
    return this.view.getFloat64(this.take(8), this.littleEndian);
  }
  /** CDR counts a terminating 0. */
  text() {
    const length = this.count(), from = this.take(length, 1), end = from + length - (this.aligned && length > 0 ? 1 : 0);
    return new TextDecoder().decode(new Uint8Array(this.view.buffer, this.view.byteOffset + from, end - from));
  }
  list(read) {
    const n = this.count();
    if (n > MOST_JOINTS) throw new Refused(`a message has a list of ${n} elements`);
    return Array.from({ length: n }, () => read());
  }
}

// Header (ROS 1: sequence number; time; frame), names, positions.
function rosState(data, isCdr) {
  if (isCdr && data.byteLength < 4) throw new Refused("a message ends too early");
  const b = isCdr ? new Bytes(data, 4, (data[1] & 1) === 1, true) : new Bytes(data, 0, true, false);
  if (!isCdr) b.count();
  b.count();
  b.count();
  b.text();
  return { name: b.list(() => b.text()), position: b.list(() => b.number()) };
}

function stateOf(channel, schema, data) {
  const isRos = /^sensor_msgs\/(msg\/)?JointState$/.test(schema?.name ?? "");
  if (isRos && channel.messageEncoding === "cdr") return rosState(data, true);
  if (isRos && channel.messageEncoding === "ros1") return rosState(data, false);
  if (channel.messageEncoding !== "json") return undefined;
  let state;
  try {
    state = JSON.parse(new TextDecoder().decode(data));
  } catch {
    throw new Refused(`a message of ${JSON.stringify(channel.topic)} is not JSON`);
  }
  return Array.isArray(state?.name) && Array.isArray(state?.position) ? state : undefined;
}

async function messages() {
  const require = createRequire(join(resolve(folder), "node_modules", "x.js"));
  const { McapStreamReader } = require("@mcap/core");
  const { loadDecompressHandlers } = require("@mcap/support");
  const reader = new McapStreamReader({ decompressHandlers: await loadDecompressHandlers() });
  const schemas = new Map(), channels = new Map(), topics = new Set(), found = [];
  for await (const part of createReadStream(file)) {
    reader.append(part);
    for (let r; (r = reader.nextRecord()) !== undefined; ) {
      if (r.type === "Schema") schemas.set(r.id, r);
      if (r.type === "Channel") channels.set(r.id, r);
      if (r.type !== "Message") continue;
      const channel = channels.get(r.channelId), state = channel && stateOf(channel, schemas.get(channel.schemaId), r.data);
      if (!state || state.position.length === 0) continue;
      if (state.name.length !== state.position.length) throw new Refused("a message has more names than positions, or fewer");
      topics.add(channel.topic);
      found.push({ time: r.logTime, ...state });
      if (found.length > MOST_ROWS) throw new Refused(`has more than ${MOST_ROWS} joint states`);
    }
  }
  if (!reader.done()) throw new Refused("ends too early: the recording is not complete");
  if (found.length === 0) throw new Refused("has no joint states: sensor_msgs/JointState, or JSON with name and position");
  if (topics.size > 1) throw new Refused(`has joint states of several topics: ${JSON.stringify([...topics].sort())}`);
  return found.sort((x, y) => (x.time < y.time ? -1 : x.time > y.time ? 1 : 0));
}

function csv(all) {
  const names = [...new Set(all.flatMap((m) => m.name))], known = new Map(), rows = [];
  if (names.length > MOST_JOINTS) throw new Refused(`has more than ${MOST_JOINTS} joints`);
  for (const name of names)
    if (typeof name !== "string" || !/^[^\s,"\p{Cc}][^,"\p{Cc}]*$/u.test(name))
      throw new Refused(`a joint has the name ${JSON.stringify(name)}`);
  for (const m of all) {
    m.name.forEach((name, i) => known.set(name, Number(m.position[i])));
    if (known.size === names.length)
      rows.push([Number(m.time - all[0].time) / 1e9, ...names.map((n) => known.get(n))].join(","));
  }
  return ["time," + names.join(","), ...rows, ""].join("\n");
}

try {
  process.stdout.write(csv(await messages()));
} catch (e) {
  const reason = e instanceof Refused ? e.message : `is not a readable MCAP file: ${e?.message ?? e}`;
  process.stdout.write("!" + reason.replace(/\p{Cc}+/gu, " ").slice(0, 400) + "\n");
}
