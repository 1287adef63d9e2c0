#pragma once

#include <functional>
#include <string>

namespace palpa::study {

/// Does `work(0)` ... `work(items - 1)` in so many processes, each taking the next one that nobody
/// has begun. What is ready before (patients, files) is shared, not copied; nothing that is open (a
/// store) may be. `steps`: how much there is to do in all; `work` says each step done with
/// `step()`, and progress is shown. Throws Error with the first message when one failed.
void shareWork(int items, int workers, int steps, bool quiet,
               const std::function<void(int item, const std::function<void()>& step)>& work);

}  // namespace palpa::study
