#pragma once

namespace palpa::bench {

/// The floor of the shipped search task: making it, looking things up on it, the tick with every
/// augmentation beside the tick with none, and how soon and how calmly the tick tells that a part
/// of the task has begun. One JSON object a line. `quick`: a small height map and few repetitions.
/// Throws Error.
void benchFloor(bool quick);

}  // namespace palpa::bench
