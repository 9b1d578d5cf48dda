import type { ShapeJson } from "./types";

/** Describes a shape: "box, half extents (0.5 0.5 0.5)". */
export function shapeLine(s: ShapeJson): string {
  const parts: string[] = [s.type.replace("_", "-")];
  for (const [k, v] of Object.entries(s)) {
    if (k === "type") continue;
    if (Array.isArray(v) && Array.isArray(v[0])) parts.push(`${v.length} ${k}`);
    else parts.push(`${k.replace("_", " ")} ${Array.isArray(v) ? "(" + v.join(" ") + ")" : String(v)}`);
  }
  return parts.join(", ");
}
