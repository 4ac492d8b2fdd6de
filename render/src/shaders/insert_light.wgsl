// Inserts the light of a point of the picture into linked lists, one for each group of pixels: star_list_heads.wgsl
// describes them.
// #import camera
// #import kernel
// #import star_list_heads
// #import star_node

@group(0) @binding(1) var<storage, read_write> list_heads: array<atomic<u32>>;
@group(0) @binding(2) var nodes: texture_storage_2d<rgba32uint, write>;

// Returns the index of the head of the list into which this node of the group is inserted.
fn list_head(group: vec2<u32>, node: u32) -> u32 {
    let index = index_of(group);
    if node < UNCOUNTED {
        return group_head(index);
    }
    let full = atomicAdd(&list_heads[group_head(lists()) + index / 2u], 1u) / LIST;
    if full == 0u {
        return group_head(index);
    }
    return overflow_head((index + 1u) * OVERFLOWS_PER_GROUP + full);
}

// Number of heads of the groups' lists, with those that pad the rows.
fn lists() -> u32 {
    return lists_across() * ((camera.size.y + GROUP_HEIGHT - 1u) / GROUP_HEIGHT);
}

// Returns the index of the head of an overflow list. Its owner is a number that stands for the group and for which of
// the group's overflow lists it is. The first invocation that asks for an owner's list claims a free one. One is always
// free, because there are more lists than the nodes can fill.
fn overflow_head(owner: u32) -> u32 {
    // Fibonacci hashing: the factor is 2³² divided by the golden ratio. It spreads the owners evenly over the lists.
    var list = (owner * 2654435769u) >> (32u - OVERFLOW_BITS);
    loop {
        var found = atomicLoad(&list_heads[OWNERS + list]);
        if found == 0u {
            let asked = atomicCompareExchangeWeak(&list_heads[OWNERS + list], 0u, owner);
            // The weak exchange may fail spuriously.
            found = select(asked.old_value, owner, asked.exchanged);
        }
        if found == owner {
            break;
        }
        if found != 0u {
            list = (list + 1u) % OVERFLOWS;
        }
    }
    return OVERFLOW_HEADS + list;
}

// Inserts the light of a point into the list of each group of pixels that its kernel touches.
fn insert(at: vec2<f32>, kernel: u32, light: vec3<f32>) {
    let reach = reach_of(kernel);
    let low = max(ceil(at - reach - 0.5), vec2(0.0));
    let high = min(floor(at + reach - 0.5), vec2<f32>(camera.size - 1u));
    if any(high < low) {
        return;
    }
    let first = group_of(vec2<u32>(low));
    let last = group_of(vec2<u32>(high));
    let count = last - first + 1u;
    var node = 1u + atomicAdd(&list_heads[0], count.x * count.y);
    let spread_light = light * kernel_factor(kernel);
    var group = first;
    // The loops test for their ends after each iteration: see star_list.wgsl.
    loop {
        group.x = first.x;
        loop {
            if node < CAPACITY {
                let next = atomicExchange(&list_heads[list_head(group, node)], node);
                let entry = Node(spread_light, at - vec2<f32>(first_pixel(group)), kernel, next);
                textureStore(nodes, texel_of(node), packed(entry));
            }
            node++;
            if group.x == last.x {
                break;
            }
            group.x++;
        }
        if group.y == last.y {
            break;
        }
        group.y++;
    }
}
