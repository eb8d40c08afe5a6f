/// The core's side of every law that a scene chooses among, for what composes plants of them. Scenes
/// themselves do not include it: a change in a law's equations leaves them as they are.
#pragma once

#include "firmware/friction/coulomb.hpp"
#include "firmware/friction/dahl.hpp"
#include "firmware/friction/iwan.hpp"
#include "firmware/friction/lugre.hpp"
#include "firmware/friction/none.hpp"
#include "firmware/friction/normal_coulomb.hpp"
#include "firmware/friction/stribeck.hpp"
#include "firmware/friction/transverse_coulomb.hpp"
