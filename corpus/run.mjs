// Asks an engine the cases of this corpus and says which of its answers are wrong. Needs Node alone.
//
//   import { run, report } from './run.mjs'      // or, for answers in a file: node run.mjs ANSWERS.jsonl [--json]
//   const engine = (c, question) => ({ overlap: true, normal: [0, 0, 1], depth: 0.25 })  // null: no such question
//   report(run(engine))                          // c.a and c.b: shape, pose, motion (README.md)
import { readdirSync, readFileSync } from 'node:fs'
import { join } from 'node:path'
import { fileURLToPath } from 'node:url'
const HERE = fileURLToPath(new URL('.', import.meta.url))
const length = v => Math.hypot(...v)
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0)

export function* cases(directory = HERE) {
  for (const file of readdirSync(join(directory, 'cases')).filter(f => f.endsWith('.json')).sort())
    yield* JSON.parse(readFileSync(join(directory, 'cases', file), 'utf8')).cases
}

function unturned(body, v) {  // v in the frame of the body
  const q = body.pose?.rotation ?? [0, 0, 0, 1], m = Math.max(...q.map(Math.abs))
  const [x, y, z, w] = [-q[0] / m, -q[1] / m, -q[2] / m, q[3] / m]
  const u = x * x + y * y + z * z, d = 2 * (x * v[0] + y * v[1] + z * v[2])
  const c = [y * v[2] - z * v[1], z * v[0] - x * v[2], x * v[1] - y * v[0]]
  return [x, y, z].map((e, i) => (d * e + (w * w - u) * v[i] + 2 * w * c[i]) / (u + w * w))
}

function support(body, direction) {  // the largest direction . x of the body, placed at the origin
  const s = body.shape, n = unturned(body, direction), h = s.half_height ?? 0, r = s.radius ?? 0
  const side = length(n.slice(0, 2))
  if (s.type === 'cylinder') return Math.abs(n[2]) * h + r * side
  if (s.type === 'cone') return Math.max(n[2] * h, r * side - n[2] * h)
  if (s.type === 'ellipsoid') return length(n.map((c, i) => c * s.semi_axes[i]))
  if (s.type === 'hull') return Math.max(...s.vertices.map(v => dot(n, v)))
  return dot(n.map(Math.abs), s.half_extents ?? [0, 0, h]) + (r ? r * length(n) : 0)  // of the other shapes
}

function width(c, n) {  // how far B must move along n to leave A
  const [a, b] = [c.a, c.b].map(body => body.pose?.translation ?? [0, 0, 0])
  return (support(c.a, n) + support(c.b, n.map(x => -x)) - dot(n, b.map((x, i) => x - a[i]))) / length(n)
}

function motionFault(c, t, tau, skin) {
  const [late, early] = [tau, tau + skin].map(x => c.truth.right_times.find(r => x <= 2 ** -r[0] * c.scale))
  if (!early || !late) return 'not judged'
  if (t === null) return c.truth.deepest > 2 ** -late[0] * c.scale ? 'missed' : null
  if (!(Number(t) >= 0 && Number(t) <= 1)) return 'not a time'
  if (early.length < 2 || Number(t) < early[1]) return 'early'
  return Number(t) > (late[2] ?? 1) ? 'late' : null
}

export function fault(c, question, answer, given) {  // null if right
  const u = 64 * 2 ** -53, limits = { tau: u * c.scale, unit: u, offset: 0, skin: 0, bias: 0, ...given }
  const { tau, offset } = limits
  if (question === 'time_of_impact') return motionFault(c, answer.time_of_impact, tau, limits.skin)
  const [low, high] = c.truth.gap, says = answer.overlap, distance = answer.distance
  const ok = Math.max(tau, question === 'distance' ? 0 : offset) >= c.scale ? 'not judged' : null
  if (says === undefined && (question !== 'distance' || distance === undefined)) return 'no number'
  if (says === true && low > tau + offset) return 'ghost'
  if (says === false && -high > tau) return 'missed'
  if (question === 'distance' && distance !== undefined)
    return low - tau <= distance && distance <= high + tau ? ok : 'distance off'
  if (question !== 'contact' || !says) return ok
  const n = answer.normal?.map(Number), depth = answer.depth
  if (n && !(Math.abs(length(n) - 1) <= limits.unit)) return 'normal not of length 1'
  const near = offset > 0 && low > 0
  let least = near ? [-high, -low] : [Math.max(0, -high), Math.max(0, -low)], w
  if (n && (w = width(c, n)) - least[1] > tau + limits.bias * Math.max(0, least[0])) return 'not the least depth'
  if (n) least = [w - least[1] <= tau ? least[0] : w, near ? w : Math.max(0, w)]
  return depth === undefined || least[0] - tau <= depth && depth <= least[1] + tau ? ok : 'depth off'
}

export function* run(engine, directory = HERE, limits) {  // yields [case, question, result]
  for (const c of cases(directory))
    for (const question of c.questions) {
      let answer, why = null
      try { answer = engine(c, question) } catch (e) { why = 'failed: ' + e.message }
      why ??= answer ? fault(c, question, answer, answer.limits ?? limits) ?? 'right' : 'unsupported'
      yield [c, question, /^(failed|right|unsupported|not judged)/.test(why) ? why : 'wrong: ' + why]
    }
}

export function report(results) {
  const count = {}
  for (const [c, question, result] of results)
    for (const flag of ['all', question, c.flags.size, c.flags.mechanism, ...c.flags.degeneracy])
      ((count[flag] ??= {})[result.split(':')[0]] ??= []).push(c.id)
  for (const flag in count)
    console.log(flag.padEnd(22), Object.keys(count[flag]).sort().map(r => `${r} ${count[flag][r].length}`).join('  '))
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const lines = readFileSync(process.argv[2], 'utf8').trim().split('\n').map(l => JSON.parse(l))
  const given = new Map(lines.map(j => [j.case + ' ' + j.question, j]))
  const recorded = (c, question) => {
    const j = given.get(c.id + ' ' + question)
    if (j?.failed) throw new Error(j.failed)
    return j?.answer && { ...j.answer, limits: j.limits }
  }
  if (!process.argv.includes('--json')) report(run(recorded))
  else console.log(JSON.stringify([...run(recorded)].map(([c, q, r]) => [c.id, q, r.split(':')[0]])))
}
