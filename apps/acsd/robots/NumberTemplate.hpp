#pragma once

#include "robots/JobData.hpp"
#include "robots/JobName.hpp"

#include <tl/expected.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

namespace ACS::Acsd
{

/// A whole number, given literally or by exactly one name of a job value: 7, "{from.cp}".
class NumberTemplate final
{
    std::variant<std::int64_t, JobName> _value;

public:
    explicit NumberTemplate(std::int64_t number = 0);

    /// The error is a sentence.
    [[nodiscard]] static tl::expected<NumberTemplate, std::string> Parse(std::string_view text);

    /// Null for a literal number.
    [[nodiscard]] const JobName* GetNameOrNull() const noexcept;

    /// Null for a name.
    [[nodiscard]] const std::int64_t* GetNumberOrNull() const noexcept;

    [[nodiscard]] std::int64_t Resolve(const JobData& data) const;
};

} // namespace ACS::Acsd
