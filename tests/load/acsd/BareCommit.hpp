#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace ACS::Load
{

/// The least that puts a text on a disk for good: a table of one column, a transaction for each text, WAL and FULL. Throws
/// what SQLite throws.
class BareCommit
{
    struct Impl;
    std::unique_ptr<Impl> _impl;

public:
    explicit BareCommit(const std::string& path);
    BareCommit(const BareCommit&) = delete;
    BareCommit& operator=(const BareCommit&) = delete;
    ~BareCommit();

    void Commit(std::string_view text);
};

} // namespace ACS::Load
