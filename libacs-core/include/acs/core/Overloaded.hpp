#pragma once

namespace ACS::Core
{

/// One visitor out of several lambdas, for std::visit: `std::visit(Overloaded{[](const A&) {…}, …}, variant)`.
template <typename... TCallables>
struct Overloaded : TCallables...
{
    using TCallables::operator()...;
};

/// Spelt out because clang 14 does not deduce aggregates.
template <typename... TCallables>
Overloaded(TCallables...) -> Overloaded<TCallables...>;

} // namespace ACS::Core
