//! Stands for [sctk-adwaita](https://docs.rs/sctk-adwaita), which draws a title bar with a font and shadows around a window if a
//! Wayland compositor leaves that to the program, as GNOME's does. winit calls it in `platform_impl/linux/wayland/window/state.rs`.
//! Here the frame is the one that winit draws without this package: smithay-client-toolkit's, with buttons and without a title.

#![cfg(all(unix, not(target_os = "macos")))]

use std::error::Error;
use std::num::NonZeroU32;
use std::sync::Arc;
use std::time::Duration;

use smithay_client_toolkit::compositor::{CompositorState, SurfaceData};
use smithay_client_toolkit::reexports::client::protocol::{wl_subsurface::WlSubsurface, wl_surface::WlSurface};
use smithay_client_toolkit::reexports::client::{Dispatch, QueueHandle, backend::ObjectId};
use smithay_client_toolkit::reexports::csd_frame::{
    CursorIcon, DecorationsFrame, FrameAction, FrameClick, WindowManagerCapabilities, WindowState,
};
use smithay_client_toolkit::shell::{WaylandSurface, xdg::fallback_frame::FallbackFrame};
use smithay_client_toolkit::shm::Shm;
use smithay_client_toolkit::subcompositor::{SubcompositorState, SubsurfaceData};

/// Colours of the real package's frame; this one has its own.
pub struct FrameConfig;

impl FrameConfig {
    pub fn auto() -> Self {
        FrameConfig
    }

    pub fn light() -> Self {
        FrameConfig
    }

    pub fn dark() -> Self {
        FrameConfig
    }
}

#[derive(Debug)]
pub struct AdwaitaFrame<State>(FallbackFrame<State>);

impl<State> AdwaitaFrame<State>
where
    State: Dispatch<WlSurface, SurfaceData> + Dispatch<WlSubsurface, SubsurfaceData> + 'static,
{
    pub fn new(
        parent: &impl WaylandSurface,
        shm: &Shm,
        _compositor: Arc<CompositorState>,
        subcompositor: Arc<SubcompositorState>,
        queue_handle: QueueHandle<State>,
        _config: FrameConfig,
    ) -> Result<Self, Box<dyn Error>> {
        FallbackFrame::new(parent, shm, subcompositor, queue_handle).map(AdwaitaFrame)
    }

    pub fn set_config(&mut self, _config: FrameConfig) {}
}

impl<State> DecorationsFrame for AdwaitaFrame<State>
where
    State: Dispatch<WlSurface, SurfaceData> + Dispatch<WlSubsurface, SubsurfaceData> + 'static,
{
    fn on_click(&mut self, timestamp: Duration, click: FrameClick, pressed: bool) -> Option<FrameAction> {
        self.0.on_click(timestamp, click, pressed)
    }

    fn click_point_moved(&mut self, timestamp: Duration, surface: &ObjectId, x: f64, y: f64) -> Option<CursorIcon> {
        self.0.click_point_moved(timestamp, surface, x, y)
    }

    fn click_point_left(&mut self) {
        self.0.click_point_left();
    }

    fn update_state(&mut self, state: WindowState) {
        self.0.update_state(state);
    }

    fn update_wm_capabilities(&mut self, capabilities: WindowManagerCapabilities) {
        self.0.update_wm_capabilities(capabilities);
    }

    fn resize(&mut self, width: NonZeroU32, height: NonZeroU32) {
        self.0.resize(width, height);
    }

    fn set_scaling_factor(&mut self, factor: f64) {
        self.0.set_scaling_factor(factor);
    }

    fn location(&self) -> (i32, i32) {
        self.0.location()
    }

    fn subtract_borders(&self, width: NonZeroU32, height: NonZeroU32) -> (Option<NonZeroU32>, Option<NonZeroU32>) {
        self.0.subtract_borders(width, height)
    }

    fn add_borders(&self, width: u32, height: u32) -> (u32, u32) {
        self.0.add_borders(width, height)
    }

    fn is_dirty(&self) -> bool {
        self.0.is_dirty()
    }

    fn set_hidden(&mut self, hidden: bool) {
        self.0.set_hidden(hidden);
    }

    fn is_hidden(&self) -> bool {
        self.0.is_hidden()
    }

    fn set_resizable(&mut self, resizable: bool) {
        self.0.set_resizable(resizable);
    }

    fn draw(&mut self) -> bool {
        self.0.draw()
    }

    fn set_title(&mut self, title: impl Into<String>) {
        self.0.set_title(title);
    }
}
