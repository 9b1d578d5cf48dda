//! The smallest useful engine in Rust: spheres against spheres. Copy it, rename it, and call your own detector from
//! `ask`. Anything that it does not support is left unchanged, i.e. "unsupported". No crate is needed:
//!
//!     rustc -O --edition 2021 --crate-type cdylib example_engine.rs -o libmine.so
//!
//! The types below are those of touchstone_engine.h, as far as this engine needs them; that header says what each
//! field means. A panic ends the host process, which is recorded as a crash of this engine.
use std::os::raw::{c_char, c_void};

const ABI_VERSION: u32 = 2;
const ANSWERED: i32 = 0;
const SPHERE: i32 = 0;
const DISTANCE: i32 = 1;
const CONTACT: i32 = 2;
const HAS_OVERLAP: u32 = 1;
const HAS_DISTANCE: u32 = 2;
const HAS_POINTS: u32 = 4;
const HAS_NORMAL: u32 = 8;
const HAS_DEPTH: u32 = 16;

#[repr(C)]
pub struct Shape {
    kind: i32,
    dimension: i32,
    size: [f64; 4],
    vertices: *const f64,
    vertex_count: usize,
    triangles: *const i32,
    triangle_count: usize,
}

#[repr(C)]
pub struct Pose {
    translation: [f64; 3],
    rotation: [f64; 4],
}

#[repr(C)]
pub struct Body {
    shape: i32,
    is_static: i32,
    has_motion: i32,
    group: i32,
    pose: Pose,
    linear: [f64; 3],
    angular: [f64; 3],
}

/// The first fields of ts_scene: the host passes scenes by pointer, and more may follow.
#[repr(C)]
pub struct Scene {
    shapes: *const Shape,
    shape_count: usize,
    bodies: *const Body,
    body_count: usize,
}

#[repr(C)]
pub struct Answer {
    outcome: i32,
    has: u32,
    overlap: i32,
    unique_gradient: i32,
    distance: f64,
    point_a: [f64; 3],
    point_b: [f64; 3],
    normal: [f64; 3],
    depth: f64,
    toi: f64,
    claimed_tolerance: f64,
    detail: [c_char; 128],
    ns: i64,
    lower: f64,
    upper: f64,
    moment: [f64; 3],
    reserved: [i64; 2],
}

/// The first callback of ts_sink.
#[repr(C)]
pub struct Sink {
    context: *mut c_void,
    point: extern "C" fn(*mut c_void, *const f64, f64),
}

#[repr(C)]
pub struct Plugin {
    abi_version: u32,
    engine_count: u32,
    card: extern "C" fn(u32) -> *const c_char,
    create: extern "C" fn(u32) -> *mut Engine,
    destroy: extern "C" fn(*mut Engine),
    load: extern "C" fn(*mut Engine, *const Scene, *const c_void, *mut c_char) -> i32,
    unload: extern "C" fn(*mut Engine),
    ask: extern "C" fn(*mut Engine, i32, i32, i32, *mut Answer, *const Sink),
    ask_many: *const c_void,
    reserved: [*const c_void; 7],
}
unsafe impl Sync for Plugin {}

pub struct Engine {
    scene: *const Scene, // valid until unload
}

extern "C" fn card(_: u32) -> *const c_char {
    concat!(
        r#"{"name":"example-rust","library":"example-rust","version":"1","settings":"spheres only","#,
        r#""unit_roundoff":1.1102230246251565e-16,"tau_factor":64,"source":"arithmetic only","shapes":["sphere"]}"#,
        "\0"
    )
    .as_ptr() as *const c_char
}

extern "C" fn create(_: u32) -> *mut Engine {
    Box::into_raw(Box::new(Engine { scene: std::ptr::null() }))
}

extern "C" fn destroy(engine: *mut Engine) {
    drop(unsafe { Box::from_raw(engine) });
}

/// The scene is used without conversion, so there is nothing to report about what was received.
extern "C" fn load(engine: *mut Engine, scene: *const Scene, _received: *const c_void, _detail: *mut c_char) -> i32 {
    unsafe { (*engine).scene = scene };
    ANSWERED
}

extern "C" fn unload(engine: *mut Engine) {
    unsafe { (*engine).scene = std::ptr::null() };
}

struct Ball {
    centre: [f64; 3],
    radius: f64,
}

fn ball(scene: &Scene, body: i32) -> Option<Ball> {
    let bodies = unsafe { std::slice::from_raw_parts(scene.bodies, scene.body_count) };
    let shapes = unsafe { std::slice::from_raw_parts(scene.shapes, scene.shape_count) };
    let body = &bodies[body as usize];
    let shape = &shapes[body.shape as usize];
    (shape.kind == SPHERE).then(|| Ball { centre: body.pose.translation, radius: shape.size[0] })
}

extern "C" fn ask(engine: *mut Engine, question: i32, a: i32, b: i32, answer: *mut Answer, sink: *const Sink) {
    let (scene, answer, sink) = unsafe { (&*(*engine).scene, &mut *answer, &*sink) };
    if question > CONTACT {
        return; // a question about the whole scene names no pair
    }
    let (a, b) = match (ball(scene, a), ball(scene, b)) {
        (Some(a), Some(b)) => (a, b),
        _ => return,
    };
    let apart: [f64; 3] = std::array::from_fn(|i| b.centre[i] - a.centre[i]);
    let length = apart.iter().map(|x| x * x).sum::<f64>().sqrt();
    // Concentric: all directions are equally good.
    let n = if length > 0.0 { apart.map(|x| x / length) } else { [0.0, 0.0, 1.0] };
    let gap = length - a.radius - b.radius;
    answer.outcome = ANSWERED;
    answer.has = HAS_OVERLAP;
    answer.overlap = (gap <= 0.0) as i32; // touching counts as overlap
    if question == DISTANCE {
        answer.has |= HAS_DISTANCE | HAS_POINTS;
        answer.distance = gap;
        answer.point_a = std::array::from_fn(|i| a.centre[i] + a.radius * n[i]);
        answer.point_b = std::array::from_fn(|i| b.centre[i] - b.radius * n[i]);
    }
    if question == CONTACT && gap <= 0.0 {
        answer.has |= HAS_NORMAL | HAS_DEPTH;
        answer.depth = -gap;
        answer.normal = n;
        let middle: [f64; 3] = std::array::from_fn(|i| a.centre[i] + (a.radius + gap / 2.0) * n[i]);
        (sink.point)(sink.context, middle.as_ptr(), -gap);
    }
}

static PLUGIN: Plugin = Plugin {
    abi_version: ABI_VERSION,
    engine_count: 1,
    card,
    create,
    destroy,
    load,
    unload,
    ask,
    ask_many: std::ptr::null(),
    reserved: [std::ptr::null(); 7],
};

#[no_mangle]
pub extern "C" fn touchstone_plugin_v1() -> *const Plugin {
    &PLUGIN
}
