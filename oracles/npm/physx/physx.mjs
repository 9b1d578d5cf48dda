// PhysX (npm physx-js-webidl) behind a pipe:  node physx.mjs FOLDER query | gjk | sim | sap | mbp | abp
import * as kit from "../adapter.mjs";
import { how, load, modules, sweep } from "./library.mjs";
import { query, supports } from "./queries.mjs";
import { broad_phase, simulation } from "./steps.mjs";

const { settings, ...questions } = { query, gjk: supports, sim: simulation }[how] ?? broad_phase(how);

// Each answer frees what the question has put on the heap.
const freed = ([name, ask]) => [name, (message, scene) => {
  try {
    return ask(message, scene);
  } finally {
    sweep();
  }
}];
kit.serve({
  card: {
    batches: how === "query" || how === "gjk", name: `physx-${how}`, library: "PhysX 5.6.1, WASM", version: kit.version(modules, "physx-js-webidl"), settings,
    source: "GuGJKPenetration.h, GuGJKRaycast.h, GuEPA.cpp: iterations end at 10 % of the smaller margin (GuVecBox.h, "
      + "GuVecConvexHull.h, GuVecCapsule.h, GuGjkQuery.cpp), or at 0.000225 of the cores' distance; GuGjkQuery.cpp: cores "
      + "shrunk by 0.1 %; GuRefGjkEpa.h: accuracy of convex cores in a step 1 % of their extents; PxCooking.h: planeTolerance",
  },
  load,
  ...Object.fromEntries(Object.entries(questions).map(freed)),
});
