#pragma once

#include <acs/core/Api.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Planning
{

/// All members of one kind that a LIF file has and DecodeLIF does not use.
struct UnusedLifMember
{
    /// How much a user of the file has to care.
    enum class EKind : std::uint8_t
    {
        Unsupported, ///< Demands something of the vehicles or of the control that has no effect.
        Unknown,     ///< Not a member of LIF 1.0: an extension, or a misspelled name.
        Informative, ///< Demands nothing: names, descriptions, optional actions, a restriction that restricts nothing.
    };

    EKind kind = EKind::Informative; ///< According to the member's name and values.
    std::string path;                ///< Without indices: "layouts[].nodes[].nodeName".
    std::string
        effect; ///< What happens without it: "CONDITIONAL actions are not sent to vehicles"; empty unless Unsupported.
    std::string first;     ///< "layouts[0].nodes[3].nodeName"
    std::size_t count = 0; ///< Number of places that have the member.
};

/// Finds the unused members of a file that DecodeLIF accepts, by kind, then by path. Members that are null count as absent.
/// Accepts any text: empty if it is not JSON.
[[nodiscard]] ACS_API std::vector<UnusedLifMember> FindUnusedMembers(std::string_view text);

} // namespace ACS::Planning
