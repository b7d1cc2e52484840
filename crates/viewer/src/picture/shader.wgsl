// A body under three lights, a floor that fades into the background, the body's shadow on it, flat bodies and faces of obstacles.
// Colours are linear. Without loops, and with a texture only where it shows, the shader is fast on software renderers too.

const BODY = 0.0;
const FLOOR = 1.0;
const SHADOW = 2.0;
const FLAT = 3.0;
const OBSTACLE = 4.0;

struct Scene {
    clip: mat4x4<f32>,       // world to clip space
    eye: vec4<f32>,          // the camera, m; w: kind of object
    up: vec4<f32>,           // unit vector; w: height of the floor along it, m
    key: vec4<f32>,          // unit vector to the strongest light; w: radius of the body, m
    fill: vec4<f32>,         // unit vector to the light from the other side; w: 1 with a picture on the body
    centre: vec4<f32>,       // of the body at rest, m
    colour: vec4<f32>,       // of the object, and its opacity
    background: vec4<f32>,   // colour into which the floor fades
}

@group(0) @binding(0) var<uniform> scene: Scene;
@group(1) @binding(0) var picture: texture_2d<f32>;
@group(1) @binding(1) var picture_sampler: sampler;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) at: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) place: vec2<f32>,
}

@vertex
fn place(
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) place: vec2<f32>,
) -> Corner {
    let kind = scene.eye.w;
    var at = position;
    if kind == SHADOW {
        // Project along the light onto the floor.
        let above = dot(position, scene.up.xyz) - scene.up.w;
        at -= scene.key.xyz * (above / dot(scene.key.xyz, scene.up.xyz));
    }
    var clip = scene.clip * vec4(at, 1.0);
    if (kind == FLOOR || kind == SHADOW) && dot(scene.eye.xyz, scene.up.xyz) < scene.up.w {
        clip = vec4(0.0, 0.0, 2.0, 1.0); // clipped: seen from below, the floor would hide the body
    }
    return Corner(clip, at, normal, place);
}

@fragment
fn paint(corner: Corner, @builtin(front_facing) outside: bool) -> @location(0) vec4<f32> {
    let kind = scene.eye.w;
    if kind == BODY {
        return vec4(lit(colour(corner), corner.at, normalize(select(-corner.normal, corner.normal, outside))), 1.0);
    }
    if kind == FLAT {
        return vec4(colour(corner), 1.0);
    }
    if kind == OBSTACLE {
        // From behind it would hide the body.
        let is_behind = dot(corner.normal, scene.eye.xyz - corner.at) < 0.0;
        return vec4(scene.colour.rgb, scene.colour.a * select(1.0, 0.15, is_behind));
    }
    let away = distance(corner.at, scene.centre.xyz) / scene.key.w;
    let floor_colour = mix(scene.colour.rgb, scene.background.rgb, smoothstep(2.0, 16.0, away));
    return vec4(floor_colour, 1.0);
}

/// The picture where it is opaque, else the colour of the object.
fn colour(corner: Corner) -> vec3<f32> {
    if scene.fill.w == 0.0 {
        return scene.colour.rgb;
    }
    let texel = textureSampleLevel(picture, picture_sampler, corner.place, 0.0);
    return mix(scene.colour.rgb, texel.rgb, texel.a);
}

fn lit(own: vec3<f32>, at: vec3<f32>, normal: vec3<f32>) -> vec3<f32> {
    let to_eye = normalize(scene.eye.xyz - at);
    let half_way = normalize(scene.key.xyz + to_eye);
    let sky = mix(vec3(0.28, 0.25, 0.23), vec3(0.42, 0.44, 0.47), 0.5 + 0.5 * dot(normal, scene.up.xyz));
    let key = vec3(1.0, 0.93, 0.83) * 0.95 * max(dot(normal, scene.key.xyz), 0.0);
    let fill = vec3(0.75, 0.85, 1.0) * 0.28 * max(dot(normal, scene.fill.xyz), 0.0);
    let gloss = vec3(0.07) * pow(max(dot(normal, half_way), 0.0), 22.0);
    let edge = vec3(0.10, 0.11, 0.12) * pow(1.0 - max(dot(normal, to_eye), 0.0), 3.0);
    return own * (sky + key + fill + edge) + gloss;
}
