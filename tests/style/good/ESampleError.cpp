#include "ESampleError.hpp"

#include <string>

namespace ACS::Sample
{

namespace
{

class SampleErrorCategory final : public std::error_category
{
public:
    [[nodiscard]] const char* name() const noexcept override
    {
        return "acs.sample";
    }

    [[nodiscard]] std::string message(int condition) const override
    {
        switch (static_cast<ESampleError>(condition))
        {
            case ESampleError::Malformed:
                return "the text has another form";
            case ESampleError::OutOfRange:
                return "the number lies outside its bounds";
            case ESampleError::UnhandledEnum:
                return "an enumerator has no case";
            default:
                return "an unknown error of the sample";
        }
    }
};

} // namespace

std::error_code make_error_code(ESampleError error) noexcept
{
    static const SampleErrorCategory CATEGORY;
    return {static_cast<int>(error), CATEGORY};
}

} // namespace ACS::Sample
