// Settings as scene files have them.
#pragma once

#include "scene/settings.hpp"

namespace orrery::test {

/// What stands behind the setting's key. Json: one of nlohmann's.
template <class Json>
Json in_file(const Setting& setting, SettingValue value) {
    if (setting.kind == SettingKind::word) return setting.words.at(value[0]);
    return setting.kind == SettingKind::number ? Json(value[0]) : Json(value);
}

}  // namespace orrery::test
