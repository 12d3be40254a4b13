#pragma once

#include "robots/JobData.hpp"
#include "robots/JobName.hpp"

#include <tl/expected.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// A text with names of the job in it: "rack {station.type}". "{{" and "}}" are braces.
class JobTemplate final
{
    struct Piece
    {
        std::string text;
        std::optional<JobName> nameOrNull; ///< What follows the text.
    };

    std::vector<Piece> _pieces;

public:
    /// The error is a text for a person.
    [[nodiscard]] static tl::expected<JobTemplate, std::string> Parse(std::string_view text);

    [[nodiscard]] std::vector<JobName> GetNames() const;

    /// What is exactly one name has the type of its value, anything else is a string. The error is the name that the job
    /// does not have.
    [[nodiscard]] tl::expected<JobValue, JobName> Resolve(const JobData& data) const;
};

} // namespace ACS::Acsd
