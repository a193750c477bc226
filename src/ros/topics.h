#pragma once

namespace block_world
{
/// Names of topics and services, private to the node: the node resolves them with its private handle, everybody else
/// as block_world/NAME.
namespace topics
{
constexpr char NODE[] = "block_world";

constexpr char THRUST[] = "thrust";
constexpr char SPRING[] = "spring";
constexpr char WRENCH[] = "wrench";

constexpr char MARKERS[] = "markers";
constexpr char OVERLAY[] = "overlay";
constexpr char BODIES[] = "bodies";
constexpr char ENERGY[] = "energy";
constexpr char CONTACTS[] = "contacts";
constexpr char INPUTS[] = "inputs";
constexpr char SCENE[] = "scene";
constexpr char PAUSED[] = "paused";

constexpr char PAUSE[] = "pause";
constexpr char RESET[] = "reset";
constexpr char STEP[] = "step";
constexpr char LOAD_SCENE[] = "load_scene";
constexpr char SET_STATE[] = "set_state";
constexpr char SPAWN_BLOCK[] = "spawn_block";
constexpr char DELETE_BLOCK[] = "delete_block";
constexpr char SAVE_STATE[] = "save_state";
constexpr char RESTORE_STATE[] = "restore_state";
}  // namespace topics
}  // namespace block_world
