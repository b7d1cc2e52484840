//! The colours of the simulation mesh: plain, those of a field, or those of the picture that the body was made from.

use std::cell::OnceCell;

use fem_mesh::generate::picture::read_pixels;
use fem_model::simulation::{PicturePlace, Shape};
use kiss3d::glamx::Vec2;
use nalgebra::Vector3;

use super::color_scale::ColorScale;
use super::frame::Frame;
use super::shader::Painting;
use super::surface::Surface;
use super::texture::{Texture, place_of_color};

/// The paint of a body, with data that are computed on first use.
#[derive(Default)]
pub struct Paint {
    painting: Painting,
    scale: Option<ColorScale>,
    colors: OnceCell<Texture>,
    /// The picture is shown wherever no field is.
    shows_picture: bool,
    /// The picture, and its size in pixels; `None` if it cannot be read.
    picture: OnceCell<Option<(Texture, Vec2)>>,
    elements: OnceCell<Vec<usize>>,
}

impl Paint {
    /// The picture that shaders draw.
    pub fn painting(&self) -> &Painting {
        &self.painting
    }

    /// The scale of the colours, if they show a field.
    pub fn scale(&self) -> Option<&ColorScale> {
        self.scale.as_ref()
    }

    /// Returns true if the body shows its picture.
    pub fn has_picture(&self) -> bool {
        self.scale.is_none() && self.painting.borrow().is_some()
    }

    /// Shows the picture where no field is shown, or plain colours.
    pub fn show_picture(&mut self, shows_picture: bool) {
        self.shows_picture = shows_picture;
    }

    /// Paints the simulation mesh as a frame asks.
    pub fn apply(&mut self, frame: &Frame, shape: &Shape, mesh: &mut Surface) {
        let Some((field, values)) = &frame.field else {
            self.scale = None;
            let painting = self.shows_picture.then(|| self.picture(shape, mesh)).flatten();
            *self.painting.borrow_mut() = painting;
            return;
        };
        let scale = ColorScale::next(self.scale, *field, values);
        let elements = self.elements.get_or_init(|| shape.mesh.elements_of_surface());
        mesh.set_texture(|triangle, _| Vec2::new(place_of_color(scale.share(values[elements[triangle]])), 0.5));
        self.scale = Some(scale);
        *self.painting.borrow_mut() = Some(self.colors.get_or_init(Texture::colors).clone());
    }

    /// The picture that the body was made from. Its place on an undeformed triangle stays there.
    fn picture(&self, shape: &Shape, mesh: &mut Surface) -> Option<Texture> {
        let place = shape.picture.as_ref()?;
        let read = || {
            let pixels = read_pixels(&place.file).ok()?;
            let size = [pixels.width, pixels.height];
            Some((Texture::new(size, &pixels.rgba), Vec2::from(size.map(|n| n as f32))))
        };
        let (texture, size) = self.picture.get_or_init(read).as_ref()?;
        let vertices = shape.mesh.vertices();
        mesh.set_texture(|_, corner| texture_coordinate(place, &vertices[corner], *size));
        Some(texture.clone())
    }
}

/// The place of an undeformed point (m) in a picture of this size (pixels): from 0 to 1, right and down from the upper left.
fn texture_coordinate(place: &PicturePlace, point: &Vector3<f64>, size: Vec2) -> Vec2 {
    let [right, above] = place.of([point.x, point.y]).map(|pixels| pixels as f32);
    Vec2::new(right / size.x, 1.0 - above / size.y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_picture_lies_on_the_undeformed_body() {
        let place = PicturePlace { file: "a.png".into(), origin: [8.0, 4.0], pixel: 0.01 };
        let at = |x: f64, y: f64| texture_coordinate(&place, &Vector3::new(x, y, 0.0), Vec2::new(100.0, 50.0));
        assert_eq!(at(0.0, 0.0), Vec2::new(0.08, 0.92));
        assert!((at(0.92, 0.46) - Vec2::new(1.0, 0.0)).length() < 1e-6, "the upper right");
    }
}
