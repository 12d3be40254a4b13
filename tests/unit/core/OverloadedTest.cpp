#include "Catch.hpp"
#include <acs/core/Overloaded.hpp>

#include <string>
#include <variant>

TEST_CASE("An overload set visits a variant with the lambda of its type")
{
    const auto describe = [](const std::variant<int, std::string>& value) {
        return std::visit(
            ACS::Core::Overloaded{
                [](int number) { return "number " + std::to_string(number); },
                [](const std::string& text) {
                    return "text " + text;
                }},
            value);
    };
    CHECK(describe(7) == "number 7");
    CHECK(describe(std::string("seven")) == "text seven");
}
