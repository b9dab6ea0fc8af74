#pragma once

#include "render/load/load_context.h"

namespace tessera {

// The emitters of daylight; the model is that of [Preetham 1999], scaled to the brightness of the one that Mitsuba
// uses, with a note.
void read_sunsky(LoadContext& context, Properties& properties);
void read_sky(LoadContext& context, Properties& properties);
void read_sun(LoadContext& context, Properties& properties);

} // namespace tessera
