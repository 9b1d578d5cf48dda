// Check boxes, and keys 1 to 6, that choose which parts of each answer are drawn.
import { LinkState, el, isTyping } from "../common/page";

export const partNames = ["normals", "depths", "points", "lines", "certificate", "polytope"] as const;
export type PartName = (typeof partNames)[number];
const titles: Record<PartName, string> = {
  normals: "arrows: the direction in which B separates from A", depths: "thick bars: the depth along the normal, to scale", points: "balls: contact and witness points",
  lines: "thin lines: closest points, candidate pairs", certificate: "the referee's plane, point or depth direction",
  polytope: "the points of A and B that prove the depth, as two wireframe polytopes",
};

export class Parts {
  readonly element = el("div", { class: "controls screen-only", id: "parts" });
  private boxes = new Map<PartName, HTMLInputElement>();

  constructor(private link: LinkState, off: readonly PartName[], private changed: () => void) {
    partNames.forEach((name, i) => {
      const box = el("input", { type: "checkbox", id: `part-${name}` });
      box.checked = !off.includes(name);
      box.addEventListener("change", () => this.tell());
      this.boxes.set(name, box);
      this.element.append(el("label", { title: `${titles[name]} (key ${i + 1})` }, box, ` ${name}`));
    });
    this.follow();
    addEventListener("keydown", (e) => {
      const box = this.boxes.get(partNames[Number(e.key) - 1]!);
      if (!box || isTyping(e)) return;
      box.checked = !box.checked;
      this.tell();
    });
  }

  private tell(): void {
    this.link.set("off", partNames.filter((n) => !this.has(n)).join(",") || "none");
    this.changed();
  }

  follow(): void {
    const off = this.link.get("off")?.split(",");
    if (off) for (const [n, b] of this.boxes) b.checked = !off.includes(n);
  }

  has = (name: PartName): boolean => this.boxes.get(name)!.checked;
}
