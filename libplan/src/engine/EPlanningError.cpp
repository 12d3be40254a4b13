#include <acs/plan/EPlanningError.hpp>

#include <string>

namespace ACS::Planning
{

namespace
{

class PlanningErrorCategory final : public std::error_category
{
public:
    [[nodiscard]] const char* name() const noexcept override
    {
        return "acs.planning";
    }

    [[nodiscard]] std::string message(int condition) const override
    {
        switch (static_cast<EPlanningError>(condition))
        {
            case EPlanningError::InvalidSite:
                return "the site map contradicts itself";
            case EPlanningError::InvalidOptions:
                return "the configuration does not fit the site";
            case EPlanningError::StoreFailed:
                return "the plan store failed";
            case EPlanningError::StoreCorrupt:
                return "the plan store is damaged or is no plan store";
            case EPlanningError::StoreTooNew:
                return "the plan store was written by a newer version";
            case EPlanningError::StoreTaken:
                return "another program uses the plan store";
            case EPlanningError::StoreOutcomeUnknown:
                return "the plan store failed and may have stored the changes";
            default:
                return "unknown planning error";
        }
    }
};

} // namespace

std::error_code make_error_code(EPlanningError error) noexcept
{
    static const PlanningErrorCategory CATEGORY;
    return {static_cast<int>(error), CATEGORY};
}

} // namespace ACS::Planning
