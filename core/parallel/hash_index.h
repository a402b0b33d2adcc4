#pragma once
/// A hash table with a logarithmic worst case.

#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace morsel::core {

/// Entries that are found by their keys: a hash table with open addressing in which a search probes a bounded
/// number of places; entries that find no free one there, as in a file made so that all its keys collide, go
/// to an ordered tree. So a search takes O(1) as a rule and O(log n) at worst, whatever the keys.
///
/// `Keys` defines the entries' keys:
///
///     static constexpr Entry kFree;                 // marks a free place
///     std::size_t hash(const Key&) const;           // its last bits are used
///     Key key(const Entry&) const;
///     bool less(const Key&, const Key&) const;      // a strict total order of the keys
///     bool equal(const Key&, const Key&) const;
template <class Entry, class Keys>
class HashIndex {
 public:
  explicit HashIndex(Keys keys = {}) : keys_(std::move(keys)), overflow_(Order{&keys_}) {}
  HashIndex(const HashIndex&) = delete;  // the tree refers to keys_
  HashIndex& operator=(const HashIndex&) = delete;

  /// The entry with this key; Keys::kFree if there is none.
  template <class Key>
  Entry find(const Key& key) const {
    const std::size_t mask = table_.size() - 1;
    std::size_t place = keys_.hash(key) & mask;
    for (int probe = 0; probe < kProbes; ++probe, place = (place + 1) & mask)
      if (table_[place] == Keys::kFree || keys_.equal(keys_.key(table_[place]), key)) return table_[place];
    const auto found = overflow_.find(key);
    return found == overflow_.end() ? Keys::kFree : *found;
  }

  /// Adds an entry unless there is one with its key; returns whether it was added.
  bool insert(const Entry& entry) {
    if (2 * (size_ + 1) > table_.size()) grow();
    const bool added = place(entry);
    size_ += added ? 1 : 0;
    return added;
  }

  std::size_t size() const { return size_; }
  /// The number of entries in the tree.
  std::size_t overflow() const { return overflow_.size(); }

 private:
  static constexpr int kProbes =
      64;  // at most half of the places are taken: with a good hash one in 10⁵ needs more

  struct Order {
    using is_transparent = void;
    const Keys* keys;
    bool operator()(const Entry& a, const Entry& b) const { return keys->less(keys->key(a), keys->key(b)); }
    template <class Key>
    bool operator()(const Entry& a, const Key& b) const {
      return keys->less(keys->key(a), b);
    }
    template <class Key>
    bool operator()(const Key& a, const Entry& b) const {
      return keys->less(a, keys->key(b));
    }
  };

  bool place(const Entry& entry) {
    const auto key = keys_.key(entry);
    const std::size_t mask = table_.size() - 1;
    std::size_t place = keys_.hash(key) & mask;
    for (int probe = 0; probe < kProbes; ++probe, place = (place + 1) & mask) {
      if (table_[place] == Keys::kFree) {
        table_[place] = entry;
        return true;
      }
      if (keys_.equal(keys_.key(table_[place]), key)) return false;
    }
    return overflow_.insert(entry).second;
  }

  void grow() {
    const std::vector<Entry> entries =
        std::exchange(table_, std::vector<Entry>(2 * table_.size(), Keys::kFree));
    const auto overflow = std::exchange(overflow_, std::set<Entry, Order>(Order{&keys_}));
    for (const Entry& entry : entries)
      if (entry != Keys::kFree) place(entry);
    for (const Entry& entry : overflow) place(entry);
  }

  Keys keys_;
  std::vector<Entry> table_ = std::vector<Entry>(1024, Keys::kFree);
  std::set<Entry, Order> overflow_;
  std::size_t size_ = 0;
};

}  // namespace morsel::core
