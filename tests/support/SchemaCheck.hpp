#pragma once

#include <acs/vda5050/EVda5050Version.hpp>
#include <acs/vda5050/Topic.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Testing
{

/// Whether ACS_SPEC_DIR names a folder with the repaired schemas of VDA5050; without it nothing is checked.
[[nodiscard]] bool HasSchemas();

/// The first error of a payload by the official schema of its topic, null if there is none: by RapidJSON's validator,
/// not by our codec, with every object of the schema closed to members that it does not name. What that validator does
/// not support is checked separately: timestamps, repeated names, and the version in the header. Throws
/// std::runtime_error if there are no schemas, or if one has a keyword that is not checked here. Any thread.
[[nodiscard]] std::optional<std::string> FindSchemaFaultOrNull(
    VDA5050::EVda5050Version version,
    VDA5050::ETopic topic,
    std::string_view payload);

/// The members that the schema names and the valid payload has nowhere: "nodes[].nodePosition.theta".
[[nodiscard]] std::vector<std::string> ListAbsentMembers(
    VDA5050::EVda5050Version version,
    VDA5050::ETopic topic,
    std::string_view payload);

/// A CHECK of the running test that the payload is valid by the schema; the topic is complete: "uagv/v2/KIT/1/state".
/// Without schemas it warns once and checks nothing. On the test's own thread.
void CheckValid(VDA5050::EVda5050Version version, std::string_view topic, std::string_view payload);

/// The same by the version in the header of the payload.
void CheckValid(std::string_view topic, std::string_view payload);

} // namespace ACS::Testing
