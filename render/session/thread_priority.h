#pragma once

namespace tessera {

/// Makes the calling thread give way to those of normal priority: what draws for the user comes first, and gets a
/// core as soon as it has something to do. Where that cannot be done, nothing happens.
void work_in_background();

/// The same to those that work in background, too: where these want all cores, it has about a quarter of the time.
void work_behind_others();

} // namespace tessera
