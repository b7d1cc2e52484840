// Reads and sets the state of one environment.

@group(0) @binding(13) var<storage, read_write> one: array<real>; // displacements and velocities of one environment: six lists
@group(0) @binding(14) var<uniform> chosen: vec4<u32>; // its number

@compute @workgroup_size(64)
fn read_state(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let node = number_of(group, groups, lane);
    if node >= sizes.nodes { return; }
    let at = place_of(node, chosen.x);
    for (var i = 0u; i < 3u; i++) {
        one[i * sizes.nodes + node] = u[at + i * stride()];
        one[(3u + i) * sizes.nodes + node] = v[at + i * stride()];
    }
}

@compute @workgroup_size(64)
fn set_state(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let node = number_of(group, groups, lane);
    if node >= sizes.nodes { return; }
    let at = place_of(node, chosen.x);
    for (var i = 0u; i < 3u; i++) {
        u[at + i * stride()] = one[i * sizes.nodes + node];
        v[at + i * stride()] = one[(3u + i) * sizes.nodes + node];
    }
}

// Elastic forces on the nodes of one environment, N.
@compute @workgroup_size(64)
fn read_forces(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let node = number_of(group, groups, lane);
    if node >= sizes.nodes { return; }
    let force = elastic_force(node, chosen.x);
    one[node] = force.x;
    one[sizes.nodes + node] = force.y;
    one[2u * sizes.nodes + node] = force.z;
}
