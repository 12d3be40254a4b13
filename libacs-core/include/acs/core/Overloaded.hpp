#pragma once

namespace ACS::Core
{

/// Combines lambdas into one visitor for std::visit: `std::visit(Overloaded{[](const A&) {…}, …}, variant)`.
template <typename... TCallables>
struct Overloaded : TCallables...
{
    using TCallables::operator()...;
};

/// Explicit because clang 14 does not deduce aggregates.
template <typename... TCallables>
Overloaded(TCallables...) -> Overloaded<TCallables...>;

} // namespace ACS::Core
