#pragma once

#include <vector>

namespace tessera {

class Scene;

/// How often emitter sampling should choose each light, beside its power: factors on that, in the order of
/// LightTable::lights(). Learnt from some hundred paths from the scene's camera, at whose ends every light is
/// tried: by power alone, an environment around a large scene takes all samples from two spots in it. Empty: there
/// is one light at most, or none that could be seen to bring anything. The same for any number of threads.
std::vector<double> learn_light_factors(const Scene& scene);

} // namespace tessera
