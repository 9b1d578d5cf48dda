// Where the camera of a picture looks: the whole scene, or close to a contact. The address remembers it.
import { type LinkState, el } from "./page";

/** What this needs of a picture in three dimensions. */
export interface Camera {
  fit(): void;
  approach(): void;
  cameraText(): string;
}

export class Look {
  /** `camera`: null where there is no picture. */
  constructor(private camera: () => Camera | null, private link: LinkState) {}

  atAll = (): void => {
    this.camera()?.fit();
    this.link.set("camera", null);
  };

  near = (): void => {
    const camera = this.camera();
    camera?.approach();
    if (camera) this.link.set("camera", camera.cameraText());
  };

  /** Buttons for devices without a keyboard and for readers who skip the list of keys. */
  buttons(near: string): HTMLElement[] {
    const all = el("button", { type: "button", title: "key f" }, "whole scene"), close = el("button", { type: "button", title: "key c", id: "near" }, near);
    all.addEventListener("click", this.atAll);
    close.addEventListener("click", this.near);
    return [all, close];
  }
}
