#pragma once

#include <acs/vda5050/EVda5050Version.hpp>
#include <acs/vda5050/Topic.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace ACS::Testing
{

/// Whether ACS_SPEC_DIR names a folder with the repaired schemas of VDA5050; without it nothing is checked.
[[nodiscard]] bool HasSchemas();

/// What is wrong with a payload by the official schema of its topic, null where nothing is: by RapidJSON's validator and
/// not by our codec, with every object of the schema closed to members that it does not name. What that validator does
/// not know is checked beside it: timestamps, names that stand twice, and that the header says this version. Throws
/// std::runtime_error where there are no schemas, or where one asks for what nothing here checks. Any thread.
[[nodiscard]] std::optional<std::string> FindSchemaFaultOrNull(
    VDA5050::EVda5050Version version,
    VDA5050::ETopic topic,
    std::string_view payload);

/// A CHECK of the running test that the payload keeps to the schema; the topic is the whole text: "uagv/v2/KIT/1/state".
/// Warns once, and checks nothing, without schemas. On the test's own thread.
void CheckValid(VDA5050::EVda5050Version version, std::string_view topic, std::string_view payload);

/// The same by the version that the payload's header says.
void CheckValid(std::string_view topic, std::string_view payload);

} // namespace ACS::Testing
