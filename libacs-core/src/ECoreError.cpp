#include <acs/core/ECoreError.hpp>

#include <string>

namespace ACS::Core
{

namespace
{

class CoreErrorCategory final : public std::error_category
{
public:
    [[nodiscard]] const char* name() const noexcept override
    {
        return "acs.core";
    }

    [[nodiscard]] std::string message(int condition) const override
    {
        switch (static_cast<ECoreError>(condition))
        {
            case ECoreError::InvalidJSON:
                return "not valid JSON";
            case ECoreError::MissingField:
                return "a required field is missing";
            case ECoreError::WrongType:
                return "a field has the wrong JSON type";
            case ECoreError::OutOfRange:
                return "a value is out of range";
            case ECoreError::UnknownWord:
                return "a name or value is not one of the defined ones";
            case ECoreError::TooLarge:
                return "too long or too deeply nested";
            case ECoreError::InvalidLocation:
                return "not a location";
            case ECoreError::InvalidTimestamp:
                return "not an ISO 8601 date and time";
            case ECoreError::InvalidIdentifier:
                return "not a valid identifier";
            case ECoreError::QueueFull:
                return "a queue is full";
            case ECoreError::UnhandledEnum:
                return "an enumerator has no case";
            default:
                return "unknown error";
        }
    }
};

} // namespace

std::error_code make_error_code(ECoreError error) noexcept
{
    static const CoreErrorCategory CATEGORY;
    return {static_cast<int>(error), CATEGORY};
}

} // namespace ACS::Core
